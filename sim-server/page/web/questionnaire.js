'use strict';
// What a driver answers after a drive of the past: hello.choices.questionnaires, one dialog for all of them.

let asked = null;  // The session whose driver is asked.

function ask_driver(session) {
  asked = session.id;
  $('askingabout').textContent = `${session.participant || t('asking.nobody')}, ${title_of(session)}, ${local_time(session.started_utc)}`
    + (session.answered.length ? `; ${t('asking.so_far', { names: session.answered.join(', ') })}` : '');
  $('askingwhich').replaceChildren(...hello.choices.questionnaires.map((one) => new Option(`${one.name}: ${one.about}`, one.name)));
  show_questionnaire();
  $('asking').showModal();
}

function show_questionnaire() {
  const questionnaire = hello.choices.questionnaires.find((one) => one.name === $('askingwhich').value);
  $('askingas').value = questionnaire.name;
  $('askingnames').replaceChildren(...['', '-before', '-after'].map((end) => new Option(questionnaire.name + end)));
  $('askingwhy').hidden = true;
  $('askingitems').replaceChildren(...questionnaire.items.map((item, i) => {
    const set = document.createElement('fieldset'), legend = document.createElement('legend'), values = document.createElement('div');
    legend.textContent = item.text;
    values.className = 'values';
    for (let value = item.least; value <= item.most; ++value) {
      const label = document.createElement('label'), radio = document.createElement('input');
      radio.type = 'radio';
      radio.name = `item ${i}`;
      radio.value = String(value);
      radio.dataset.item = item.id;
      const words = item.labels[value - item.least] || '';
      label.append(radio, words && words !== String(value) ? `${value} ${words}` : String(value));
      values.append(label);
    }
    set.append(legend, values);
    return set;
  }));
}

$('askingwhich').onchange = show_questionnaire;
$('askingno').onclick = () => $('asking').close();
$('askingform').onsubmit = (event) => {
  event.preventDefault();
  const answers = {};
  for (const radio of $('askingitems').querySelectorAll('input:checked')) answers[radio.dataset.item] = Number(radio.value);
  ask({ do: 'answer', session: asked, questionnaire: $('askingwhich').value, as: $('askingas').value.trim(), answers }, (answer) => {
    if (answer.ok) return $('asking').close();
    $('askingwhy').textContent = t('asking.not_kept', { why: heard(answer.why) });
    $('askingwhy').hidden = false;
  });
};
