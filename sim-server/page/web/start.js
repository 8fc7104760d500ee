'use strict';
// Without a drive: one is chosen and started. What a school needs stands first; what studies need lies behind a fold.

const of_experiment = 'experiment:';  // The value of an experiment's option begins so, for it may be called like a scenario.

function option(value, text, about) {
  const made = document.createElement('option');
  made.value = value;
  made.textContent = text;
  made.title = about || '';
  return made;
}

/// As people call it: a lesson by its title, in this language where Septet came with it.
function name_of_drive(choice) {
  const key = `scenario.${choice.name}`;
  if (!choice.own && has_text(key)) return t(key);
  if (!choice.own) return choice.title || choice.name;
  return `${choice.title || choice.name.replace(/^.*\//, '').replace(/\.(xosc|toml)$/, '')} · ${choice.name}`;
}

function about_drive(choice) {
  const key = `about.${choice.name}`;
  return !choice.own && has_text(key) ? t(key) : choice.about;
}

/// Lessons, games, experiments and what else there is, each under its heading.
function fill_drives() {
  const { scenarios, experiments } = hello.choices, list = $('choosescenario');
  const chosen = list.value || localStorage.getItem('choosescenario');
  const groups = [['start.lessons', scenarios.filter((one) => one.kind === 'lesson'), ''], ['start.games', scenarios.filter((one) => one.kind === 'game'), ''],
                  ['start.other_drives', scenarios.filter((one) => one.kind === 'drive'), ''], ['start.experiments', experiments || [], of_experiment]];
  list.replaceChildren(...groups.filter(([, members]) => members.length).map(([heading, members, begin]) => {
    const group = document.createElement('optgroup');
    group.label = t(heading);
    group.append(...members.map((one) => option(begin + one.name, name_of_drive(one), about_drive(one))));
    return group;
  }));
  if ([...list.options].some((one) => one.value === chosen)) list.value = chosen;
}

function make_start() {
  document.title = t('shell.title');
  $('scenario').textContent = 'Septet';
  $('about').textContent = t('shell.no_drive');
  document.body.classList.remove('paused');
  const { rigs, drivers, vehicles, first_rig } = hello.choices;
  const fill_choice = (id, list, none) => {
    const chosen = $(id).value || localStorage.getItem(id);
    $(id).replaceChildren(option('', none), ...list.map((one) => option(one.name, one.name, one.about)));
    if (list.some((one) => one.name === chosen)) $(id).value = chosen;
  };
  fill_drives();
  fill_choice('chooserig', rigs, first_rig || t('start.rig_default'));
  fill_choice('choosedriver', drivers, t('start.driver_of_rig'));
  fill_choice('choosevehicle', vehicles, t('start.vehicle_of_rig'));
  for (const id of ['chooserig', 'choosedriver', 'choosevehicle']) $(id).onchange = () => localStorage.setItem(id, $(id).value);
  $('choosescenario').onchange = () => { localStorage.setItem('choosescenario', $('choosescenario').value); show_scenario(); };
  show_scenario();
}

/// What is chosen: the scenario or the experiment.
function chosen_drive() {
  const value = $('choosescenario').value;
  if (value.startsWith(of_experiment)) return hello.choices.experiments.find((one) => of_experiment + one.name === value);
  return hello.choices.scenarios.find((one) => one.name === value);
}

/// What it is, and a scenario's parameters with their own values. An experiment chooses the rest by itself.
function show_scenario() {
  const drive = chosen_drive(), parameters = (drive && drive.parameters) || [], is_experiment = $('choosescenario').value.startsWith(of_experiment);
  $('scenarioabout').textContent = !drive ? t('start.no_scenario') : [about_drive(drive), is_experiment ? t('start.experiment_about') : ''].filter(Boolean).join(' ');
  const typed = new Map([...$('parameters').querySelectorAll('input')].map((input) => [input.dataset.parameter, input.value]));
  const keeps = $('parameters').dataset.of === $('choosescenario').value;
  $('parameters').dataset.of = $('choosescenario').value;
  $('parameters').replaceChildren(...parameters.map(({ name, value }) => {
    const label = document.createElement('label'), input = document.createElement('input');
    input.placeholder = value;
    input.dataset.parameter = name;
    input.maxLength = 200;
    input.autocomplete = 'off';
    if (keeps) input.value = typed.get(name) || '';
    label.append(name, input);
    return label;
  }));
  $('parametersbox').hidden = !parameters.length;
  for (const id of ['choosedriver', 'choosevehicle', 'drivenote', 'group', 'condition', 'order', 'seed', 'seconds']) $(id).disabled = is_experiment;
}

function chosen() {
  const choice = { do: 'start', start_now: $('startnow').checked, parameters: {} };
  for (const [member, id] of Object.entries({ scenario: 'choosescenario', rig: 'chooserig', driver: 'choosedriver', vehicle: 'choosevehicle', participant: 'participant',
    group: 'group', condition: 'condition', order: 'order', note: 'drivenote', seed: 'seed', seconds: 'seconds' })) choice[member] = $(id).value.trim();
  if (choice.scenario.startsWith(of_experiment)) {
    choice.experiment = choice.scenario.slice(of_experiment.length);
    choice.scenario = '';
  }
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

$('startform').onsubmit = (event) => {
  event.preventDefault();
  ask(chosen(), (answer) => { if (!answer.ok) alarm(t('start.not_started', { why: heard(answer.why) })); });
};
// What is wrong behind the fold is shown.
$('researchbox').addEventListener('invalid', () => { $('researchbox').open = true; }, true);
$('cancel').onclick = () => ask({ do: 'cancel' }, () => {});
