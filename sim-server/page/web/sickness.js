'use strict';
// How the driver feels, asked each minute of driven time (MISC): hello.rating is the scale, state.rating the minute and whether it has its answer.

function make_sickness() {
  $('sicknessbox').hidden = !hello.rating;
  if (!hello.rating) return;
  $('sicknesstitle').textContent = hello.rating.title;
  $('sicknesstext').textContent = hello.rating.text;
  $('sickness').replaceChildren(...hello.rating.labels.map((label, i) => {
    const button = document.createElement('button'), value = document.createElement('b'), words = document.createElement('span');
    button.type = 'button';
    value.textContent = String(hello.rating.least + i);
    words.textContent = label;
    button.append(value, words);
    button.onclick = () => rate(hello.rating.least + i);
    return button;
  }));
}

/// From nausea on it is for the operator to end the drive, and the reason is at hand.
const nausea = 6;
function rate(value) {
  ask({ do: 'rate', value }, (answer) => {
    if (!answer.ok) return log({ text: t('shell.not_done', { why: heard(answer.why) }) }, true);
    if (value < nausea) return;
    $('reason').value = t('sickness.reason', { value });
    offer_end(true);
  });
}

function show_sickness() {
  const now = state.rating;
  if (!hello.rating || !now) return;
  const due = !now.answered && now.minute > 0;
  $('sicknessbox').classList.toggle('due', due);
  // It opens when it is time to ask, and closes once that has been answered.
  const key = `${now.minute} ${due}`;
  if ($('sicknessbox').dataset.key !== key) $('sicknessbox').open = due;
  $('sicknessbox').dataset.key = key;
  $('sicknessdue').textContent = now.answered ? t('sickness.answered', now) : now.minute > 0 ? t('sickness.due', now) : t('sickness.before');
  [...$('sickness').children].forEach((button, i) => {
    button.disabled = now.answered;
    button.setAttribute('aria-pressed', String(now.answered && now.value === hello.rating.least + i));
  });
}
