'use strict';
// Things are placed by a click on the map, and who belongs to the scenario is hidden and shown again.

let placing = false;

function make_things() {
  $('thing').replaceChildren(...hello.things.map((name) => option(name, name.replaceAll('-', ' '))));
  $('thing').value = hello.things.includes('traffic-cone') ? 'traffic-cone' : hello.things[0];
  set_placing(false);
}

function set_placing(on) {
  placing = on;
  $('place').setAttribute('aria-pressed', String(on));
  $('place').textContent = on ? 'Click on the map' : 'Place on the map';
  canvas.classList.toggle('placing', on);
}

/// The map was clicked there: world metres.
function place_at(x, y) {
  set_placing(false);
  change(`place x_m=${+x.toFixed(2)} y_m=${+y.toFixed(2)} part=${$('thing').value}`);
}

function show_entities() {
  const list = $('entities'), key = JSON.stringify(state.entities);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  list.replaceChildren(...state.entities.map(({ name, shown }) => {
    const item = document.createElement('li'), button = document.createElement('button');
    button.type = 'button';
    button.textContent = `${shown ? 'Hide' : 'Show'} ${name}`;
    button.onclick = () => change(`${shown ? 'hide' : 'show'} entity=${name}`);
    item.append(button);
    return item;
  }));
}

$('place').onclick = () => set_placing(!placing);
