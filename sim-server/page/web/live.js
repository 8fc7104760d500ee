'use strict';
// What changes of a drive, ten times a second: the car, the storyboard, who commands.

function make_drive() {
  document.title = `${hello.scenario}: operator`;
  $('scenario').textContent = hello.scenario;
  $('about').textContent = [hello.rig, hello.vehicle, hello.participant, `seed ${hello.seed}`].filter(Boolean).join(' · ');
  $('trafficbox').hidden = !hello.has_traffic;
  $('thumbnails').replaceChildren();
  make_conditions();
  make_sickness();
  make_things();
  make_road();
}

function show_command() {
  const other = state && state.commander;
  mine = Boolean(hello && other && other.browser === hello.you) && socket && socket.readyState === WebSocket.OPEN;
  $('controls').disabled = $('choice').disabled = !mine;
  $('take').textContent = mine ? 'Let go' : 'Take command';
  const watching = state ? ` · ${state.browsers} looking on` : '';
  $('commander').textContent = (mine ? 'You command' : other ? `${other.name || 'Somebody'} commands` : 'Nobody commands') + watching;
}

function show_state() {
  const s = state, car = s.car;
  document.body.classList.toggle('paused', s.paused);
  const ended = s.phase.startsWith('ended');
  $('phase').textContent = ended ? 'ended' : s.paused ? 'paused' : s.phase;
  $('pause').textContent = s.paused || s.phase.startsWith('waiting') ? 'Go on' : 'Pause';
  if (ended) alarm(`The drive has ${s.phase}.`);
  else if (s.actuators && s.actuators.alarm) alarm(`${s.actuators.alarm}. Fan, shaker and wheel force are at 0.`);
  else if (s.actuators && s.actuators.cut) alarm(`Fan, shaker and wheel force are cut: ${s.actuators.cut}.`);
  $('rearm').hidden = !(s.actuators && s.actuators.cut);
  show_command();
  $('driven').textContent = s.sim_s === undefined ? '–' : `${s.sim_s.toFixed(1)}${hello.planned_s ? ` / ${hello.planned_s}` : ''} s`;
  $('tick').textContent = s.tick ?? '–';
  $('factor').textContent = s.paused ? '–' : `× ${s.real_time_factor.toFixed(2)}`;
  if (car) {
    $('speed').textContent = (3.6 * Math.abs(car.speed_mps)).toFixed(0);
    $('gap').textContent = s.leader ? s.leader.gap_m.toFixed(s.leader.gap_m < 10 ? 1 : 0) : '–';
    const behind_s = s.leader && car.speed_mps > 1 ? ` (${(s.leader.gap_m / car.speed_mps).toFixed(1)} s)` : '';
    $('gapunit').textContent = s.leader ? `m to leader${behind_s}` : 'm: no leader';
    $('lateral').textContent = car.lane === 0 ? '–' : car.lateral_m.toFixed(2).replace('-', '−');
    $('throttle').value = car.accelerator;
    $('brake').value = car.brake;
    const mark = $('lane').firstElementChild, width = Math.max(2.5, car.lane_width_m || 3.5), share = 100 * 1.85 / width;
    mark.style.width = `${share}%`;
    mark.style.left = `${Math.max(-share, Math.min(100, 50 - 100 * (car.lateral_m || 0) / width - share / 2))}%`;
    mark.hidden = car.lane === 0;
    $('more').textContent = `gear ${car.gear} · ${car.rpm} rpm · wheel ${degrees(car.wheel_rad)} · lane ${car.lane || 'none'} · ${s.collisions} collisions`;
  }
  show_sickness();
  s.conditions.forEach((value, i) => sliders[i] && sliders[i](value));
  show_triggers();
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
    item.textContent = 'Nothing is left to begin.';
    list.append(item);
  }
}
