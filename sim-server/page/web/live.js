'use strict';
// What changes of a drive, ten times a second: the car, the storyboard, who commands.

function make_drive() {
  document.title = t('drive.title', hello);
  $('scenario').textContent = hello.scenario;
  $('about').textContent = [hello.rig, hello.vehicle, hello.participant, t('drive.seed', hello)].filter(Boolean).join(' · ');
  $('trafficbox').hidden = !hello.has_traffic;
  $('thumbnails').replaceChildren();
  $('aloudbox').hidden = !hello.speaks;
  $('novoice').hidden = hello.speaks;
  make_conditions();
  make_lesson();
  make_car();
  tell_again();
  make_sickness();
  make_things();
  make_placing();
  make_road();
}

function show_command() {
  const other = state && state.commander;
  mine = Boolean(hello && other && other.browser === hello.you) && socket && socket.readyState === WebSocket.OPEN;
  $('controls').disabled = $('choice').disabled = !mine;
  $('take').textContent = t(mine ? 'shell.let_go' : 'shell.take');
  const watching = state ? ` · ${t('shell.looking_on', { count: state.browsers })}` : '';
  $('commander').textContent = (mine ? t('shell.you_command') : other ? t('shell.commands', { name: other.name || t('shell.somebody') }) : t('shell.nobody_commands')) + watching;
}

const has_ended = (s) => s.phase.startsWith('ended');
const stands_still = () => Boolean(state && (state.paused || (state.phase || '').startsWith('waiting')));
const why_ended = (s) => heard(s.phase.replace(/^ended: /, ''));

/// What goes on, as the server says it, in the page's language.
function phase_words(phase) {
  if (phase === 'driving') return t('drive.driving');
  if (phase === 'waiting for the driver') return t('drive.waiting_driver');
  const waiting = /^waiting for (.*?)( \(Enter: drive without\))?$/.exec(phase);
  return waiting ? t(waiting[2] ? 'drive.waiting_can_go' : 'drive.waiting', { whom: waiting[1] }) : phase;
}

function show_state() {
  const s = state, car = s.car;
  document.body.classList.toggle('paused', s.paused);
  const ended = has_ended(s);
  $('phase').textContent = ended ? t('drive.ended') : s.paused ? t('drive.paused') : phase_words(s.phase);
  $('pause').textContent = t(stands_still() ? 'controls.go_on' : 'controls.pause');
  if (ended) alarm(t('shell.has_ended', { why: why_ended(s) }));
  else if (s.alarm) alarm(s.actuators ? t('drive.actuators_at_0', { alarm: heard(s.alarm) }) : heard(s.alarm));
  else if (s.actuators && s.actuators.cut) alarm(t('drive.actuators_cut', { why: heard(s.actuators.cut) }));
  else if (s.fault) alarm(t('event.actuators_cut', { why: heard(s.fault) }));
  $('rearm').hidden = !s.fault;
  show_command();
  $('driven').textContent = s.sim_s === undefined ? '–' : `${s.sim_s.toFixed(1)}${hello.planned_s ? ` / ${hello.planned_s}` : ''} s`;
  $('tick').textContent = s.tick ?? '–';
  $('factor').textContent = s.paused ? '–' : `× ${s.real_time_factor.toFixed(2)}`;
  if (car) {
    $('speed').textContent = (3.6 * Math.abs(car.speed_mps)).toFixed(0);
    $('gap').textContent = s.leader ? s.leader.gap_m.toFixed(s.leader.gap_m < 10 ? 1 : 0) : '–';
    const behind_s = s.leader && car.speed_mps > 1 ? ` (${(s.leader.gap_m / car.speed_mps).toFixed(1)} s)` : '';
    $('gapunit').textContent = s.leader ? t('car.to_leader') + behind_s : t('car.no_leader');
    $('lateral').textContent = car.lane === 0 ? '–' : car.lateral_m.toFixed(2).replace('-', '−');
    $('throttle').value = car.accelerator;
    $('brake').value = car.brake;
    const mark = $('lane').firstElementChild, width = Math.max(2.5, car.lane_width_m || 3.5), share = 100 * 1.85 / width;
    mark.style.width = `${share}%`;
    mark.style.left = `${Math.max(-share, Math.min(100, 50 - 100 * (car.lateral_m || 0) / width - share / 2))}%`;
    mark.hidden = car.lane === 0;
    $('more').textContent = t('car.more', { ...car, wheel: degrees(car.wheel_rad), lane: car.lane || t('car.no_lane'), collisions: s.collisions });
  }
  show_sickness();
  show_car();
  s.conditions.forEach((value, i) => sliders[i] && sliders[i](value));
  show_triggers();
  show_hazards();
  show_entities();
  show_screens();
  age_thumbnails();
  show_near();
}

/// An element of the storyboard by its own name and that of what holds it.
function short_name(name) {
  const parts = name.split('::'), own = parts.pop(), parent = parts.pop();
  return parent && parent !== own ? `${own} (${parent})` : own;
}

function show_hazards() {
  const list = $('hazards'), key = JSON.stringify(state.hazards);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  const chosen = list.value;
  list.replaceChildren(...state.hazards.map((name) => new Option(name)));
  if (state.hazards.includes(chosen)) list.value = chosen;
  $('hazardrow').hidden = !state.hazards.length;
}

function show_triggers() {
  const list = $('triggers'), key = JSON.stringify(state.triggers);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  list.replaceChildren(...state.triggers.map((name) => {
    const item = document.createElement('li'), button = document.createElement('button');
    button.type = 'button';
    button.textContent = short_name(name);
    button.title = name;
    button.onclick = () => change(`trigger element=${name}`);
    item.append(button);
    return item;
  }));
  if (!state.triggers.length) {
    const item = document.createElement('li');
    item.className = 'quiet';
    item.textContent = t('controls.nothing_left');
    list.append(item);
  }
}
