'use strict';
// Things are placed by a click on the map and taken away again, and who belongs to the scenario is hidden and shown again.

const name_of_thing = (name) => heard(name.replaceAll('-', ' '));

function make_things() {
  $('thing').replaceChildren(...hello.things.map((name) => option(name, name_of_thing(name))));
  $('thing').value = hello.things.includes('traffic-cone') ? 'traffic-cone' : hello.things[0];
  set_map_click(null);
}

/// The map was clicked there: world metres.
function place_at(x, y) {
  set_map_click(null);
  change(`place x_m=${+x.toFixed(2)} y_m=${+y.toFixed(2)} part=${$('thing').value}`);
}

/// A list of buttons, made anew when what they do has changed: [what it says, the command].
function show_buttons(list, buttons) {
  const key = JSON.stringify(buttons);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  list.replaceChildren(...buttons.map(([says, what]) => {
    const item = document.createElement('li'), button = document.createElement('button');
    button.type = 'button';
    button.textContent = says;
    button.onclick = () => change(what);
    item.append(button);
    return item;
  }));
}

function show_entities() {
  show_buttons($('entities'), state.entities.map(({ name, shown }) => [t(shown ? 'controls.hide' : 'controls.show', { name }), `${shown ? 'hide' : 'show'} entity=${name}`]));
  // After a crash there are more pieces than anybody takes away one by one; all of them are on the map.
  show_buttons($('lying'), state.lying.slice(-12).map(({ id, name }) => [t('controls.take_away', { name: name_of_thing(name), id }), `remove thing=${id}`]));
}

