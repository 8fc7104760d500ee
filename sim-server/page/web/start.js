'use strict';
// Without a drive: one is chosen and started, and past ones are looked at.

function option(value, text, about) {
  const made = document.createElement('option');
  made.value = value;
  made.textContent = text;
  made.title = about || '';
  return made;
}

function make_start() {
  document.title = t('shell.title');
  $('scenario').textContent = 'Septet';
  $('about').textContent = t('shell.no_drive');
  document.body.classList.remove('paused');
  const { scenarios, rigs, drivers, vehicles } = hello.choices;
  const fill_choice = (id, list, none) => {
    const chosen = $(id).value || localStorage.getItem(id);
    $(id).replaceChildren(...(none ? [option('', none)] : []), ...list.map((one) => option(one.name, one.name, one.about)));
    if (list.some((one) => one.name === chosen)) $(id).value = chosen;
  };
  fill_choice('choosescenario', scenarios);
  fill_choice('chooserig', rigs, t('start.rig_default'));
  fill_choice('choosedriver', drivers, t('start.driver_of_rig'));
  fill_choice('choosevehicle', vehicles, t('start.vehicle_of_rig'));
  for (const id of ['chooserig', 'choosedriver', 'choosevehicle']) $(id).onchange = () => localStorage.setItem(id, $(id).value);
  $('choosescenario').onchange = () => { localStorage.setItem('choosescenario', $('choosescenario').value); show_scenario(); };
  show_scenario();
}

/// What the scenario is, and its parameters with their own values.
function show_scenario() {
  const scenario = hello.choices.scenarios.find((one) => one.name === $('choosescenario').value);
  $('scenarioabout').textContent = scenario ? scenario.about : t('start.no_scenario');
  $('parameters').replaceChildren(...(scenario ? scenario.parameters : []).map(({ name, value }) => {
    const label = document.createElement('label'), input = document.createElement('input');
    input.placeholder = value;
    input.dataset.parameter = name;
    input.maxLength = 200;
    input.autocomplete = 'off';
    label.append(name, input);
    return label;
  }));
  $('parametersbox').hidden = !scenario || !scenario.parameters.length;
}

function chosen() {
  const choice = { do: 'start', start_now: $('startnow').checked, parameters: {} };
  for (const [member, id] of Object.entries({ scenario: 'choosescenario', rig: 'chooserig', driver: 'choosedriver', vehicle: 'choosevehicle', participant: 'participant',
    group: 'group', condition: 'condition', order: 'order', note: 'drivenote', seed: 'seed', seconds: 'seconds' })) choice[member] = $(id).value.trim();
  for (const input of $('parameters').querySelectorAll('input')) if (input.value.trim()) choice.parameters[input.dataset.parameter] = input.value.trim();
  return choice;
}

function show_start() {
  const s = state;
  show_command();
  $('phase').textContent = t(s.starting ? 'shell.making_ready' : 'shell.ready');
  $('startbutton').disabled = s.starting;
  $('cancel').hidden = !s.starting;
  $('startcommand').textContent = s.command;
  $('startsaid').textContent = s.said.join('\n');
  $('startsaid').hidden = !s.said.length || (!s.starting && !s.failed);
  $('startlast').textContent = s.starting ? t('start.reading') : s.last ? t('start.last', { how: heard(s.last) }) : t('start.nothing_yet');
  $('startlast').classList.toggle('failed', s.failed);
  show_sessions();
}

function show_sessions() {
  const body = $('sessions'), key = JSON.stringify(state.sessions);
  if (body.dataset.key === key) return;
  body.dataset.key = key;
  body.replaceChildren(...state.sessions.map((session) => {
    const row = document.createElement('tr');
    const cell = (text, title) => {
      const made = row.insertCell();
      made.textContent = text;
      if (title) made.title = title;
      return made;
    };
    cell(session.started_utc.replace('T', ' ').replace('Z', ''), session.folder);
    cell(session.scenario, session.rig);
    cell(session.participant || '–');
    cell(session.driver || t('past.a_person'));
    cell(session.simulated_s ? `${session.simulated_s.toFixed(0)} s` : '–');
    cell(has_text(`end.${session.ended}`) ? t(`end.${session.ended}`) : session.ended.replaceAll('_', ' '));
    cell(session.answered.join(', ') || '–');
    const files = cell('');
    for (const [file, name, is_there] of [['report.html', t('past.report'), session.has_report], ['debrief.html', t('past.debrief'), session.has_debrief]]) {
      if (!is_there) continue;
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = name;
      button.onclick = () => look(session.id, file);
      files.append(button);
    }
    if (hello.choices.questionnaires.length) {
      const button = document.createElement('button');
      button.type = 'button';
      button.className = 'questionnaire';
      button.textContent = t('past.questionnaire');
      button.onclick = () => ask_driver(session);
      files.append(button);
    }
    return row;
  }));
  $('nosessions').hidden = state.sessions.length > 0;
}

/// A report in a tab of its own. That is opened at once, or the browser takes it for a pop-up.
function look(id, file) {
  const tab = window.open('about:blank');
  ask({ do: 'look', session: id, file }, (answer) => {
    if (answer.ok && tab) tab.location = new URL(answer.path, location.href);
    else {
      if (tab) tab.close();
      alarm(answer.why ? heard(answer.why) : t('past.no_tab'));
    }
  });
}

$('startform').onsubmit = (event) => {
  event.preventDefault();
  ask(chosen(), (answer) => { if (!answer.ok) alarm(t('start.not_started', { why: heard(answer.why) })); });
};
$('cancel').onclick = () => ask({ do: 'cancel' }, () => {});
