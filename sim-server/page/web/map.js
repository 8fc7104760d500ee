'use strict';
// The road from above with everybody on it.

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
  if (!hello || hello.choices || !road) return;
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
    let model = hello.models[p[1]];
    if (!model) continue;
    if (p.length > 6) model = {...model, length: p[6], width: p[7], rear: p[6] / 2};  // A box has its own size.
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
  pen.fillStyle = '#ff7a45';
  const half = Math.max(0.2, 3 / view.scale);
  for (const { x_m, y_m } of (state && state.lying) || []) pen.fillRect(x_m - half, y_m - half, 2 * half, 2 * half);
  draw_placed();
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

/// World metres under a pointer.
const place_of = (event) => [view.x + (event.offsetX - canvas.clientWidth / 2) / view.scale, view.y - (event.offsetY - canvas.clientHeight / 2) / view.scale];

/// What the next click on the map does, by the button that was pressed for it; null: it moves the map.
let map_click = null;
const map_click_words = { place: 'controls.place', put: 'controls.put', hazard: 'controls.hazard', placestock: 'controls.place', pick: 'placing.pick', guideclick: 'controls.guide_click' };
function set_map_click(does) {
  map_click = does;
  for (const [id, word] of Object.entries(map_click_words)) {
    $(id).setAttribute('aria-pressed', String(id === does));
    $(id).textContent = t(id === does ? 'controls.click_map' : word);
  }
  canvas.classList.toggle('placing', does !== null);
}
for (const id of Object.keys(map_click_words)) $(id).onclick = () => set_map_click(map_click === id ? null : id);

let held = null;
canvas.onpointerdown = (event) => {
  const there = place_of(event);
  if (map_click === 'place' && mine) return place_at(...there);
  if (map_click === 'put' && mine) return put_at(...there);
  if (map_click === 'guideclick' && mine) { set_map_click(null); return change(`to ${there.map((at) => at.toFixed(1)).join(',')}`); }
  if (map_click === 'hazard' && mine) return set_hazard_at(...there);
  if (grasp(...there, event)) { if (grip) canvas.setPointerCapture(event.pointerId); return; }
  held = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId);
};
canvas.onpointermove = (event) => {
  if (drag(...place_of(event), event) || !held) return;
  move(event.clientX - held[0], event.clientY - held[1]);
  held = [event.clientX, event.clientY];
};
canvas.onpointerup = () => { let_go(); held = null; };
canvas.onpointercancel = () => { grip = held = null; };
canvas.addEventListener('wheel', (event) => { event.preventDefault(); zoom(event.deltaY < 0 ? 1.2 : 1 / 1.2, event.offsetX, event.offsetY); }, { passive: false });
canvas.onkeydown = (event) => {
  const does = { ArrowLeft: () => move(60, 0), ArrowRight: () => move(-60, 0), ArrowUp: () => move(0, 60), ArrowDown: () => move(0, -60),
                 '+': () => zoom(1.3), '-': () => zoom(1 / 1.3), f: () => follow(true) }[event.key];
  if (placing_key(event)) event.preventDefault();
  else if (does) { event.preventDefault(); does(); }
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
