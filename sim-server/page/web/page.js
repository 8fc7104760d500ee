'use strict';
// The operator's page. PROTOCOL.md beside the server's sources says what is said over the socket.
const $ = (id) => document.getElementById(id);
const token = location.hash.slice(1);
const silence_ms = 1000;  // Without a state for longer than that, what is shown is old.

let socket = null, hello = null, state = null, before = null;
let came_ms = 0, interval_ms = 100, number = 0, mine = false, refused = 0;
const waiting = new Map();  // Message number → what to do with its answer.
const rates = new Map();    // Screen → pictures counted lately.

// ---- The socket

function connect() {
  let opened = false;
  try {
    socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/live`, ['septet', token]);
  } catch (error) {
    return alarm('The address has no token: open the one that the server has printed, with all that follows the #.');
  }
  socket.onopen = () => { opened = true; refused = 0; };
  socket.onmessage = (message) => receive(JSON.parse(message.data));
  socket.onclose = () => {
    waiting.clear();
    mine = false;
    document.body.classList.add('stale');
    if (!opened) ++refused;
    const ended = state && state.phase.startsWith('ended');
    if (ended) alarm(`The drive has ${state.phase}.`);
    else if (refused > 1) alarm('The server does not answer, or the token is another drive’s: open the address that it has printed.');
    else alarm('The connection is lost. The drive goes on without this page; trying again.');
    show_command();
    if (!ended || refused < 20) setTimeout(connect, Math.min(5000, 500 * (1 + refused)));
  };
}

function ask(what, then) {
  if (!socket || socket.readyState !== WebSocket.OPEN) return;
  waiting.set(++number, then);
  socket.send(JSON.stringify({ id: number, ...what }));
}

/// What only who commands may ask for.
function command(what) {
  ask(what, (answer) => { if (!answer.ok) log(null, `not done: ${answer.why}`, true); });
}
const change = (text) => command({ do: 'change', command: text });

function receive(message) {
  if (message.type === 'hello') {
    hello = message;
    state = before = null;
    $('events').replaceChildren();
    make_page();
    ask({ do: 'take', name: $('name').value }, show_command);
  } else if (message.type === 'state') {
    const now = performance.now();
    before = state;
    if (state) interval_ms = Math.min(500, Math.max(30, now - came_ms));
    state = message;
    came_ms = now;
    document.body.classList.remove('stale');
    $('alarm').hidden = true;
    show_state();
  } else if (message.type === 'answer') {
    const then = waiting.get(message.id);
    waiting.delete(message.id);
    if (then) then(message);
  } else if (message.type === 'event') {
    log(message.sim_s, message.text);
  }
}

function alarm(text) {
  $('alarm').textContent = text;
  $('alarm').hidden = false;
}

function log(sim_s, text, is_mine) {
  const line = document.createElement('li'), time = document.createElement('time'), words = document.createElement('span');
  time.textContent = sim_s === null ? 'now' : `${sim_s.toFixed(1)} s`;
  words.textContent = text.replace(/element=(.*) state=/, (all, name) => `${short_name(name)} `);
  words.title = text;
  if (is_mine || /^(mark|operator)/.test(text)) words.className = 'mine';
  line.append(time, words);
  $('events').prepend(line);
  while ($('events').children.length > 300) $('events').lastChild.remove();
}

// ---- What is fixed for a drive

const degrees = (rad) => `${(rad * 180 / Math.PI).toFixed(0)}°`;
const percent = (share) => `${(100 * share).toFixed(0)} %`;
// How each condition is called and read; `bend` > 1 gives small values more of the slider.
const words = {
  rain_mm_per_h: { label: 'Rain, snowfall', read: (v) => `${v.toFixed(1)} mm/h`, bend: 2 },
  road_wetness: { label: 'Wet road', read: percent },
  snow_cover: { label: 'Snow on road', read: percent },
  visibility_m: { label: 'Fog: sight', read: (v) => v < 2000 ? `${v.toFixed(0)} m` : `${(v / 1000).toFixed(1)} km`, bend: 4 },
  cloud_cover: { label: 'Clouds', read: percent },
  temperature_k: { label: 'Temperature', read: (v) => `${(v - 273.15).toFixed(1)} °C` },
  wind_speed_mps: { label: 'Wind', read: (v) => `${v.toFixed(1)} m/s` },
  wind_direction_rad: { label: 'Wind towards', read: degrees },
  sun_elevation_rad: { label: 'Sun’s height', read: degrees },
  sun_azimuth_rad: { label: 'Sun’s bearing', read: degrees },
  sun_illuminance_lux: { label: 'Sunlight', read: (v) => `${v.toFixed(0)} lx`, bend: 3 },
  friction_scale: { label: 'Grip', read: percent },
};
const presets = {
  'Clear': 'rain_mm_per_h=0 road_wetness=0 snow_cover=0 visibility_m=20000 cloud_cover=0.2 temperature_k=288.15',
  'Rain': 'rain_mm_per_h=6 road_wetness=0.6 snow_cover=0 visibility_m=4000 cloud_cover=0.9 temperature_k=284.15',
  'Cloudburst': 'rain_mm_per_h=40 road_wetness=1 snow_cover=0 visibility_m=800 cloud_cover=1 temperature_k=284.15',
  'Fog': 'rain_mm_per_h=0 visibility_m=90 cloud_cover=1',
  'Snow': 'rain_mm_per_h=4 road_wetness=0.2 snow_cover=0.8 visibility_m=1500 cloud_cover=1 temperature_k=270.15',
  'Day': 'sun_elevation_rad=0.7 sun_illuminance_lux=80000',
  'Dusk': 'sun_elevation_rad=0.02 sun_illuminance_lux=1000',
  'Night': 'sun_elevation_rad=-0.4 sun_illuminance_lux=0',
};
const sliders = [];

function make_page() {
  document.title = `${hello.scenario}: operator`;
  $('scenario').textContent = hello.scenario;
  $('about').textContent = [hello.rig, hello.vehicle, hello.participant, `seed ${hello.seed}`].filter(Boolean).join(' · ');
  $('trafficbox').hidden = !hello.has_traffic;
  $('presets').replaceChildren(...Object.entries(presets).map(([name, text]) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = name;
    button.onclick = () => change(`conditions ${text}`);
    return button;
  }));
  sliders.length = 0;
  $('conditions').replaceChildren(...hello.conditions.map((condition) => {
    const known = words[condition.name] || { label: condition.name, read: (v) => v.toFixed(2) };
    const label = document.createElement('label'), name = document.createElement('span'), value = document.createElement('output');
    const slider = document.createElement('input');
    const bend = known.bend || 1, span = condition.most - condition.least;
    Object.assign(slider, { type: 'range', min: 0, max: 1000 });
    name.textContent = known.label;
    const read = () => condition.least + span * (slider.value / 1000) ** bend;
    slider.oninput = () => { value.textContent = known.read(read()); slider.held = performance.now(); };
    slider.onchange = () => { slider.held = performance.now(); change(`conditions ${condition.name}=${+read().toPrecision(4)}`); };
    label.append(name, slider, value);
    sliders.push((now) => {
      if (performance.now() - (slider.held || -1e9) < 1500) return;
      slider.value = 1000 * (Math.max(0, now - condition.least) / span) ** (1 / bend);
      value.textContent = known.read(now);
    });
    return label;
  }));
  make_road();
}

// ---- What changes

function show_command() {
  const other = state && state.commander;
  mine = Boolean(hello && other && other.browser === hello.you) && socket && socket.readyState === WebSocket.OPEN;
  $('controls').disabled = !mine;
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
  s.conditions.forEach((value, i) => sliders[i] && sliders[i](value));
  show_triggers();
  show_screens();
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

/// A table's rows anew, each a list of texts; `looks` gives a row its class.
function fill(body, rows, looks) {
  while (body.rows.length > rows.length) body.deleteRow(-1);
  rows.forEach((row, i) => {
    const line = body.rows[i] || body.insertRow();
    line.className = looks ? looks(i) : '';
    row.forEach((text, j) => { const cell = line.cells[j] || line.insertCell(); if (cell.textContent !== text) cell.textContent = text; });
  });
}

function show_screens() {
  const rows = state.screens.map((screen) => {
    const seen = rates.get(screen.name) || [];
    seen.push([state.wall_s, screen.frames]);
    while (seen.length > 2 && seen[0][0] < state.wall_s - 2) seen.shift();
    rates.set(screen.name, seen);
    const [from, to] = [seen[0], seen[seen.length - 1]];
    const rate = to[0] > from[0] ? (to[1] - from[1]) / (to[0] - from[0]) : 0;
    return [screen.live ? screen.name : `${screen.name} (away)`, rate.toFixed(1), screen.live ? `${screen.frame_ms.toFixed(0)} ms` : '–',
            screen.behind_ms === null ? '–' : `${screen.behind_ms.toFixed(0)} ms`, String(screen.lost), String(screen.drop_outs)];
  });
  fill($('screens'), rows.length ? rows : [['no screens in this drive', '', '', '', '', '']],
       (i) => state.screens[i] && !state.screens[i].live ? 'away' : '');
}

function show_near() {
  const all = state.everybody || [], own = all.find((p) => p[0] === hello.driver);
  if (!own) return;
  const rows = all.filter((p) => p !== own).map((p) => [Math.hypot(p[2] - own[2], p[3] - own[3]), p]).sort((a, b) => a[0] - b[0]).slice(0, 8)
    .map(([away, p]) => [`${hello.models[p[1]].name} ${p[0]}`, `${away.toFixed(0)} m`, (3.6 * p[5]).toFixed(0)]);
  fill($('near'), rows);
}

// ---- The map

const canvas = $('map'), pen = canvas.getContext('2d', { alpha: false });
const view = { x: 0, y: 0, scale: 3, follow: true };  // World metres in the middle, pixels a metre.
let road = null;

function make_road() {
  road = { grounds: new Path2D(), edges: new Path2D(), lines: new Path2D(), low: [1e9, 1e9], high: [-1e9, -1e9] };
  for (const shape of hello.road) {
    const path = shape.kind === 0 ? road.grounds : shape.kind === 1 ? road.edges : road.lines, p = shape.points;
    for (let i = 0; i + 1 < p.length; i += 2) {
      if (i) path.lineTo(p[i], p[i + 1]); else path.moveTo(p[i], p[i + 1]);
      road.low = [Math.min(road.low[0], p[i]), Math.min(road.low[1], p[i + 1])];
      road.high = [Math.max(road.high[0], p[i]), Math.max(road.high[1], p[i + 1])];
    }
    if (shape.kind === 0) path.closePath();
  }
}

/// Everybody where they are at this instant, between the last two states.
function places() {
  if (!state || !state.everybody) return [];
  if (!before || !before.everybody) return state.everybody;
  const part = Math.min(1, (performance.now() - came_ms) / interval_ms);
  const old = new Map(before.everybody.map((p) => [p[0], p]));
  return state.everybody.map((p) => {
    const from = old.get(p[0]);
    if (!from || Math.hypot(p[2] - from[2], p[3] - from[3]) > 80) return p;
    const turn = Math.atan2(Math.sin(p[4] - from[4]), Math.cos(p[4] - from[4]));
    return [p[0], p[1], from[2] + part * (p[2] - from[2]), from[3] + part * (p[3] - from[3]), from[4] + part * turn, p[5]];
  });
}

const kinds = { 5: 'bicycle', 6: 'pedestrian', 7: 'ambulance' };

function draw() {
  requestAnimationFrame(draw);
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.fillStyle = '#1c2a20';
  pen.fillRect(0, 0, canvas.width, canvas.height);
  if (!hello || !road) return;
  const all = places(), own = all.find((p) => p[0] === hello.driver);
  if (own && view.follow) [view.x, view.y] = [own[2], own[3]];
  const k = view.scale * ratio;
  pen.setTransform(k, 0, 0, -k, canvas.width / 2 - k * view.x, canvas.height / 2 + k * view.y);
  pen.fillStyle = '#3a424b';
  pen.fill(road.grounds, 'nonzero');
  pen.strokeStyle = '#3a424b';
  pen.lineWidth = Math.max(0.2, 1.5 / view.scale);
  pen.stroke(road.grounds);
  if (view.scale > 0.7) {
    pen.strokeStyle = '#9aa5b0';
    pen.lineWidth = Math.max(0.15, 0.8 / view.scale);
    pen.setLineDash([3, 6]);
    pen.stroke(road.lines);
    pen.setLineDash([]);
    pen.strokeStyle = '#d5dde5';
    pen.stroke(road.edges);
  }
  const least = (p) => (p === own ? 16 : 7) / view.scale;  // Nobody is smaller than that on the screen.
  const leader = state && state.leader ? state.leader.id : -1;
  for (const p of [...all.filter((q) => q !== own), ...(own ? [own] : [])]) {
    const model = hello.models[p[1]];
    if (!model) continue;
    const big = Math.max(1, least(p) / model.length);
    pen.save();
    pen.translate(p[2], p[3]);
    pen.rotate(p[4]);
    pen.scale(big, big);
    pen.fillStyle = p === own ? '#ffb020' : p[0] === leader ? '#5fd08a' : kinds[model.kind] === 'ambulance' ? '#62a8ff' : '#c3ccd5';
    pen.beginPath();
    const x = -model.rear, w = Math.max(model.width, 0.5), h = w / 2, nose = Math.min(1.2, 0.3 * model.length);
    pen.moveTo(x, -h);
    pen.lineTo(x + model.length - nose, -h);
    pen.lineTo(x + model.length, -0.45 * h);
    pen.lineTo(x + model.length, 0.45 * h);
    pen.lineTo(x + model.length - nose, h);
    pen.lineTo(x, h);
    pen.closePath();
    pen.fill();
    pen.strokeStyle = '#0b0e11';
    pen.lineWidth = 0.8 / (view.scale * big);
    pen.stroke();
    pen.restore();
  }
  const nice = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000].find((m) => m * view.scale > 70) || 10000;
  $('scale').style.width = `${nice * view.scale}px`;
  $('scale').firstElementChild.textContent = nice < 1000 ? `${nice} m` : `${nice / 1000} km`;
}

function zoom(by, at_x = canvas.clientWidth / 2, at_y = canvas.clientHeight / 2) {
  const dx = at_x - canvas.clientWidth / 2, dy = canvas.clientHeight / 2 - at_y, old = view.scale;
  view.scale = Math.min(40, Math.max(0.01, view.scale * by));
  if (view.follow) return;
  view.x += dx / old - dx / view.scale;
  view.y += dy / old - dy / view.scale;
}
function follow(on) {
  view.follow = on;
  $('follow').setAttribute('aria-pressed', String(on));
}
function move(dx, dy) {
  follow(false);
  view.x -= dx / view.scale;
  view.y += dy / view.scale;
}

let held = null;
canvas.onpointerdown = (event) => { held = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); };
canvas.onpointermove = (event) => {
  if (!held) return;
  move(event.clientX - held[0], event.clientY - held[1]);
  held = [event.clientX, event.clientY];
};
canvas.onpointerup = canvas.onpointercancel = () => { held = null; };
canvas.addEventListener('wheel', (event) => { event.preventDefault(); zoom(event.deltaY < 0 ? 1.2 : 1 / 1.2, event.offsetX, event.offsetY); }, { passive: false });
canvas.onkeydown = (event) => {
  const does = { ArrowLeft: () => move(60, 0), ArrowRight: () => move(-60, 0), ArrowUp: () => move(0, 60), ArrowDown: () => move(0, -60),
                 '+': () => zoom(1.3), '-': () => zoom(1 / 1.3), f: () => follow(true) }[event.key];
  if (does) { event.preventDefault(); does(); }
};
$('in').onclick = () => zoom(1.4);
$('out').onclick = () => zoom(1 / 1.4);
$('follow').onclick = () => follow(!view.follow);
$('whole').onclick = () => {
  if (!road || road.high[0] < road.low[0]) return;
  follow(false);
  view.x = (road.low[0] + road.high[0]) / 2;
  view.y = (road.low[1] + road.high[1]) / 2;
  view.scale = Math.min(canvas.clientWidth / (road.high[0] - road.low[0] + 20), canvas.clientHeight / (road.high[1] - road.low[1] + 20));
};

// ---- What the operator does

$('take').onclick = () => {
  if (mine) return ask({ do: 'release' }, show_command);
  ask({ do: 'take', name: $('name').value }, (answer) => {
    if (answer.ok) return;
    $('takingtext').textContent = `${(state.commander && state.commander.name) || 'Somebody'} commands this drive now and will only look on.`;
    $('taking').showModal();
  });
};
$('taking').onclose = () => { if ($('taking').returnValue === 'yes') ask({ do: 'take', name: $('name').value, by_force: true }, show_command); };
$('name').value = localStorage.getItem('name') || '';
$('name').onchange = () => {
  localStorage.setItem('name', $('name').value);
  if (mine) ask({ do: 'take', name: $('name').value }, show_command);
};
$('pause').onclick = () => command({ do: $('pause').textContent === 'Pause' ? 'pause' : 'go_on' });
$('rearm').onclick = () => command({ do: 'rearm' });
$('end').onclick = () => { $('ending').returnValue = ''; $('ending').showModal(); };
$('ending').onclose = () => { if ($('ending').returnValue === 'yes') command({ do: 'end', reason: $('reason').value }); };
$('markform').onsubmit = (event) => {
  event.preventDefault();
  command({ do: 'mark', note: $('note').value });
  $('note').value = '';
};
$('trafficform').onsubmit = (event) => {
  event.preventDefault();
  change(`traffic vehicles=${Math.max(0, Math.min(3000, Math.round(+$('vehicles').value || 0)))}`);
};

setInterval(() => {
  if (!state || state.phase.startsWith('ended') || !socket || socket.readyState !== WebSocket.OPEN) return;
  const silent_ms = performance.now() - came_ms;
  if (silent_ms < silence_ms) return;
  document.body.classList.add('stale');
  alarm(`No word from the drive for ${(silent_ms / 1000).toFixed(0)} s: what is shown is old.`);
}, 250);
connect();
requestAnimationFrame(draw);
