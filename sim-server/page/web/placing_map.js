'use strict';
// The map's part of placing: what was placed is drawn, grasped, moved and turned there, by mouse, finger or keys.

let grip = null;  // What a pointer holds: { does, pointer, x, y, from, heading }, world metres and degrees.

const turn_of = (from_x, from_y, to_x, to_y) => Math.atan2(to_y - from_y, to_x - from_x) * 180 / Math.PI;
/// A thing is at least so long on the screen, so that a finger finds it.
const shown_half = (thing) => [Math.max(thing.length_m / 2, 7 / view.scale), Math.max(thing.width_m / 2, 7 / view.scale)];
/// Where the chosen thing is grasped to be turned: ahead of it.
function handle_of(thing) {
  const away = shown_half(thing)[0] + 22 / view.scale, rad = thing.heading_deg * Math.PI / 180;
  return [thing.middle_x_m + away * Math.cos(rad), thing.middle_y_m + away * Math.sin(rad)];
}

function things_on_map() {
  const all = placed.things.slice();
  for (const one of [...found, ...(selected ? [selected] : [])]) if (!all.some((thing) => thing.id === one.id)) all.push(one);
  return all;
}

function thing_at(x, y) {
  return things_on_map().findLast((thing) => {
    const rad = -thing.heading_deg * Math.PI / 180, dx = x - thing.middle_x_m, dy = y - thing.middle_y_m, [half_x, half_y] = shown_half(thing);
    return Math.abs(dx * Math.cos(rad) - dy * Math.sin(rad)) <= half_x && Math.abs(dx * Math.sin(rad) + dy * Math.cos(rad)) <= half_y;
  });
}

/// True if the map's click is for placing, and not for moving the map.
function grasp(x, y, event) {
  if (!mine || !stock.has_scene) return false;
  const held = (does, more = {}) => { grip = { does, pointer: event.pointerId, x, y, from: [x, y], screen: [event.clientX, event.clientY], ...more }; return true; };
  if (map_click === 'placestock') return held('place', { heading: +$('placingheading').value || 0 });
  if (map_click === 'pick') { pick_at(x, y); return true; }
  const near_handle = selected && Math.hypot(...handle_of(selected).map((at, i) => at - [x, y][i])) * view.scale < 18;
  if (near_handle) return held('turn', { heading: selected.heading_deg });
  const thing = thing_at(x, y);
  if (!thing) return false;
  choose(thing);
  return held('move', { heading: thing.heading_deg });
}

function drag(x, y, event) {
  if (!grip || event.pointerId !== grip.pointer) return Boolean(grip);
  const far = Math.hypot(event.clientX - grip.screen[0], event.clientY - grip.screen[1]);
  grip.moved = grip.moved || far > 6;
  [grip.x, grip.y] = [x, y];
  if (grip.does === 'place' && far > 12) grip.heading = turn_of(...grip.from, x, y);
  if (grip.does === 'turn') grip.heading = turn_of(selected.x_m, selected.y_m, x, y);
  return true;
}

function let_go() {
  const was = grip;
  grip = null;
  if (!was) return;
  if (was.does === 'place') {
    $('placingheading').value = metres(was.heading);
    set_map_click(null);
    place_stock_at(...was.from, was.heading);
  } else if (was.moved && selected && was.does === 'move') {
    move_chosen(selected.x_m + was.x - was.from[0], selected.y_m + was.y - was.from[1], selected.heading_deg);
  } else if (was.moved && selected) {
    move_chosen(selected.x_m, selected.y_m, was.heading);
  }
}

/// As it would be if the pointer were let go now.
function as_held(thing) {
  if (!grip || !selected || thing.id !== selected.id || !grip.moved) return thing;
  if (grip.does === 'turn') return { ...thing, heading_deg: grip.heading };
  const dx = grip.x - grip.from[0], dy = grip.y - grip.from[1];
  return grip.does === 'move' ? { ...thing, middle_x_m: thing.middle_x_m + dx, middle_y_m: thing.middle_y_m + dy } : thing;
}

function draw_box(thing, stroke, fill) {
  const [half_x, half_y] = shown_half(thing);
  pen.save();
  pen.translate(thing.middle_x_m, thing.middle_y_m);
  pen.rotate(thing.heading_deg * Math.PI / 180);
  pen.globalAlpha = thing.shown ? 1 : 0.45;
  pen.beginPath();
  pen.rect(-half_x, -half_y, 2 * half_x, 2 * half_y);
  if (fill) { pen.fillStyle = fill; pen.fill(); }
  pen.strokeStyle = stroke;
  pen.lineWidth = (thing.solid ? 3 : 1.5) / view.scale;
  if (!thing.shown) pen.setLineDash([4 / view.scale, 3 / view.scale]);
  pen.stroke();
  pen.setLineDash([]);
  pen.beginPath();
  pen.moveTo(half_x, 0);
  pen.lineTo(half_x + 6 / view.scale, 0);
  pen.stroke();
  pen.restore();
}

/// Called by the map with the pen in world metres.
function draw_placed() {
  for (const thing of things_on_map()) {
    const is_chosen = selected && thing.id === selected.id, shown = as_held(thing);
    draw_box(shown, is_chosen ? '#8fc7ff' : thing.placed ? '#d9a6ff' : '#9fe0b0', thing.placed ? '#7a4fa366' : null);
    if (!is_chosen || !mine) continue;
    const [x, y] = handle_of(shown);
    pen.fillStyle = '#8fc7ff';
    pen.beginPath();
    pen.arc(x, y, 7 / view.scale, 0, 2 * Math.PI);
    pen.fill();
  }
  if (map_click !== 'placestock') return;
  const [length_m, width_m, ahead_m] = size_of_stock();
  const [x, y] = grip ? grip.from : [view.x, view.y], heading = grip ? grip.heading : +$('placingheading').value || 0, rad = heading * Math.PI / 180;
  draw_box({ middle_x_m: x + ahead_m * Math.cos(rad), middle_y_m: y + ahead_m * Math.sin(rad), heading_deg: heading, length_m, width_m, shown: true }, '#ffd98a', '#ffd98a40');
}

/// Keys of the map beside those that move it; true if the key was one.
function placing_key(event) {
  const is_placing = map_click === 'placestock', is_picking = map_click === 'pick';
  if (event.key === 'Escape' && (is_placing || is_picking || grip || selected)) {
    if (is_placing || is_picking || grip) { grip = null; set_map_click(null); } else choose(null);
    return true;
  }
  if (event.key === 'Enter' && is_placing) {
    set_map_click(null);
    place_stock_at(view.x, view.y, +$('placingheading').value || 0);
    return true;
  }
  if (event.key === 'Enter' && is_picking) { pick_at(view.x, view.y); return true; }
  return false;
}
