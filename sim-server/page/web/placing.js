'use strict';
// What is placed in the world: the list of what there is, the lines by which a thing is placed, moved, hidden, made solid, and what was placed.
// The map's part is placing_map.js. Each change is an editor's line (docs/editing.md), done by the drive's one gate or refused with its reason.

let stock = { has_scene: false, stock: [], own_models: [] }, placed = { things: [], more: 0 };
let found = [];  // What was found near the last click.
let selected = null;  // The thing that the buttons change, as it was heard last.
let awaited = '';  // Name of a thing that is to be chosen once it is heard of.
let named = 0;

const quoted = (text) => `"${text.replace(/[\\"]/g, '\\$&')}"`;
const metres = (value) => +value.toFixed(2);
/// "tree/412.5/-81.0" for people: its kind in their language, then its place.
const name_of_node = (name) => { const parts = name.split('/'); return [heard(parts[0]), ...parts.slice(1)].join(' / '); };
const name_of_kind = (kind) => heard(kind);
const name_of_stock = (one) => heard(one.name.replaceAll('-', ' '));

function hear_stock(message) {
  stock = message;
  placed = { things: [], more: 0 };
  found = [];
  choose(null);
  make_placing();
}

function hear_placed(message) {
  placed = message;
  const newest = (thing) => placed.things.find((one) => one.id === thing.id);
  found = found.map((thing) => newest(thing) || thing).filter((thing) => !thing.placed || newest(thing));
  const next = awaited ? placed.things.find((thing) => thing.name === awaited) : selected && newest(selected);
  if (awaited && next) awaited = '';
  if (next) choose(next); else if (selected && selected.placed) choose(null); else look_again();
  show_placed();
}

/// What is chosen of the generated world is as it was once the list has it no more.
function look_again() {
  if (!selected || selected.placed) return;
  ask({ do: 'find_near', x_m: selected.x_m, y_m: selected.y_m, within_m: 1 }, (answer) => {
    const again = (answer.found || []).find((thing) => selected && thing.id === selected.id);
    if (!again) return;
    found = found.map((thing) => thing.id === again.id ? again : thing);
    choose(again);
  });
}

function said(text, is_bad = false) {
  $('placingsaid').textContent = text;
  $('placingsaid').classList.toggle('bad', is_bad);
}

/// Has lines done, all or none; `then` when they are.
function edit(lines, then = () => {}) {
  ask({ do: 'edit', lines: lines.join('\n') }, (answer) => {
    said(answer.ok ? '' : t('shell.not_done', { why: heard(answer.why) }), !answer.ok);
    if (answer.ok) then(); else { awaited = ''; show_chosen(); }
  });
}

// ---- what there is

function make_placing() {
  $('placingbox').hidden = !stock.has_scene;
  set_map_click(null);
  show_stock();
  show_placed();
  show_chosen();
}

function show_stock() {
  const wanted = $('stocksearch').value.toLocaleLowerCase(language).split(/\s+/).filter(Boolean), before_chosen = $('stock').value, groups = new Map();
  const add = (kind, text, value) => {
    if (!wanted.every((word) => `${kind} ${text}`.toLocaleLowerCase(language).includes(word))) return;
    if (!groups.has(kind)) groups.set(kind, []);
    groups.get(kind).push(option(value, text));
  };
  stock.own_models.forEach((name, i) => add(t('placing.own'), name, `own ${i}`));
  stock.stock.forEach((one, i) => add(name_of_kind(one.kind), name_of_stock(one), `stock ${i}`));
  $('stock').replaceChildren(...[...groups].sort(([a], [b]) => a.localeCompare(b, language)).map(([kind, options]) => {
    const group = document.createElement('optgroup');
    group.label = kind;
    group.append(...options);
    return group;
  }));
  const values = [...$('stock').options].map((one) => one.value);
  $('stock').value = values.includes(before_chosen) ? before_chosen : values[0] || '';
  $('nostock').hidden = values.length > 0;
  $('placestock').disabled = !values.length;
}

/// Length and width of what would be placed, and how far ahead of its origin its middle is; of a file they are not known before.
function size_of_stock() {
  const [kind, i] = $('stock').value.split(' ');
  const one = kind === 'stock' ? stock.stock[i] : null, model = one && hello.models.find((model) => `model/${model.name}` === one.node);
  return one ? [one.length_m, one.width_m, model ? model.length / 2 - model.rear : 0] : [2, 2, 0];
}

/// A name that nothing has had here.
function fresh_name(label) {
  const taken = new Set(placed.things.map((thing) => thing.name));
  const plain = `placed/${label.replace(/[^\p{L}\p{N}]+/gu, '-')}`;
  do ++named; while (taken.has(`${plain}/${named}`));
  return `${plain}/${named}`;
}

function place_stock_at(x, y, heading) {
  const [kind, i] = $('stock').value.split(' ');
  const one = kind === 'stock' ? stock.stock[i] : null, name = fresh_name(one ? one.name : stock.own_models[i].replace(/\.glb$/, ''));
  const at = `${metres(x)} ${metres(y)} ground ${metres(heading)}`;
  const lines = [one ? `like ${quoted(name)} ${one.node} ${at}` : `import ${quoted(name)} ${quoted(stock.own_models[i])} ${at}`];
  if ($('placingsolid').checked) lines.push(`solid ${quoted(name)}`);
  awaited = name;
  edit(lines, () => said(t('placing.is_placed', { name: name_of_node(name) })));
}

/// Asks what stands near there, and chooses the nearest.
function pick_at(x, y) {
  set_map_click(null);
  ask({ do: 'find_near', x_m: metres(x), y_m: metres(y), within_m: Math.max(15, 24 / view.scale) }, (answer) => {
    found = answer.found || [];
    said(found.length ? '' : t('placing.found_none'), !found.length);
    choose(found[0] || null);
    show_placed();
  });
}

// ---- what is chosen

function choose(thing) {
  selected = thing;
  show_chosen();
}

function show_chosen() {
  $('chosenbox').hidden = !selected;
  for (const button of document.querySelectorAll('#placedlist button, #foundlist button')) button.setAttribute('aria-pressed', String(Boolean(selected) && +button.value === selected.id));
  if (!selected) return;
  $('chosenname').textContent = name_of_node(selected.name);
  for (const [id, value] of [['chosenx', selected.x_m], ['choseny', selected.y_m], ['chosenheading', selected.heading_deg]])
    if (document.activeElement !== $(id)) $(id).value = metres(value);
  $('hidechosen').textContent = t(selected.shown ? 'placing.hide' : 'placing.show');
  $('solidchosen').setAttribute('aria-pressed', String(selected.solid));
  $('removechosen').hidden = !selected.placed;
}

function move_chosen(x, y, heading) {
  if (!selected) return;
  found = found.map((thing) => thing.id === selected.id ? { ...thing, x_m: x, y_m: y, heading_deg: heading } : thing);
  edit([`move ${selected.node} ${metres(x)} ${metres(y)} ground ${metres(heading)}`]);
}

function show_placed() {
  show_choices($('placedlist'), placed.things);
  show_choices($('foundlist'), found.filter((one) => !placed.things.some((thing) => thing.id === one.id)));
  $('placedmore').hidden = !placed.more;
  $('placedmore').textContent = t('placing.more', { count: placed.more });
  $('noplaced').hidden = placed.things.length > 0;
  show_chosen();
}

function show_choices(list, things) {
  const key = JSON.stringify(things.map((thing) => [thing.id, thing.name, thing.shown, thing.solid]));
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  list.replaceChildren(...things.map((thing) => {
    const item = document.createElement('li'), button = document.createElement('button');
    button.type = 'button';
    button.value = thing.id;
    button.textContent = [name_of_node(thing.name), ...(thing.shown ? [] : [t('placing.hidden')]), ...(thing.solid ? [t('placing.solid_word')] : [])].join(' · ');
    button.onclick = () => { choose([...placed.things, ...found].find((one) => one.id === thing.id) || null); look_at_chosen(); };
    item.append(button);
    return item;
  }));
}

/// The map goes to what is chosen where it is not to be seen.
function look_at_chosen() {
  if (!selected) return;
  const half_x = canvas.clientWidth / 2 / view.scale, half_y = canvas.clientHeight / 2 / view.scale;
  if (Math.abs(selected.x_m - view.x) < half_x && Math.abs(selected.y_m - view.y) < half_y) return;
  follow(false);
  [view.x, view.y] = [selected.x_m, selected.y_m];
}

$('stocksearch').oninput = show_stock;
$('chosenform').onsubmit = (event) => {
  event.preventDefault();
  move_chosen(+$('chosenx').value, +$('choseny').value, +$('chosenheading').value);
};
$('hidechosen').onclick = () => edit([`${selected.shown ? 'hide' : 'show'} ${selected.node}`]);
$('solidchosen').onclick = () => edit([`solid ${selected.node}${selected.solid ? ' off' : ''}`]);
$('removechosen').onclick = () => edit([`remove ${selected.node}`]);
$('undoedit').onclick = () => ask({ do: 'change', command: 'undo' }, (answer) => said(answer.ok ? t('placing.undone') : t('shell.not_done', { why: heard(answer.why) }), !answer.ok));
$('saveform').onsubmit = (event) => {
  event.preventDefault();
  ask({ do: 'save_edits', name: $('editsname').value.trim() }, (answer) => said(answer.ok ? t('placing.saved', answer) : t('shell.not_done', { why: heard(answer.why) }), !answer.ok));
};
