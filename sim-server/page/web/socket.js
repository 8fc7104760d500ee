'use strict';
// What is said to the server and heard of it: PROTOCOL.md beside the server's sources. With a drive `hello` and `state` are of that; without one
// `hello.choices` are what a drive is chosen from.
const $ = (id) => document.getElementById(id);
const token = location.hash.slice(1);
const silence_ms = 1000;  // Without a state for longer than that, what is shown is old.

let moved = false;  // Another program serves the page from now on.
let socket = null, hello = null, state = null, before = null;
let came_ms = 0, interval_ms = 100, number = 0, mine = false, refused = 0;
const waiting = new Map();  // Message number → what to do with its answer.

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
    const ended = state && state.phase && state.phase.startsWith('ended');
    if (moved) quiet();
    else if (ended) alarm(`The drive has ${state.phase}.`);
    else if (refused > 1) alarm('The server does not answer, or the token is another drive’s: open the address that it has printed.');
    else alarm('The connection is lost. What goes on goes on without this page; trying again.');
    show_command();
    setTimeout(connect, moved ? 50 : Math.min(5000, 500 * (1 + refused)));
    moved = false;
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
    $('startmain').hidden = !hello.choices;
    $('drivemain').hidden = $('clock').hidden = Boolean(hello.choices);
    hello.choices ? make_start() : make_drive();
    ask({ do: 'take', name: $('name').value }, show_command);
  } else if (message.type === 'state') {
    const now = performance.now();
    before = state;
    if (state) interval_ms = Math.min(500, Math.max(30, now - came_ms));
    state = message;
    came_ms = now;
    quiet();
    show_state();
  } else if (message.type === 'start_state') {
    state = message;
    quiet();
    show_start();
  } else if (message.type === 'thumbnail') {
    show_thumbnail(message);
  } else if (message.type === 'moved') {
    moved = true;
  } else if (message.type === 'answer') {
    const then = waiting.get(message.id);
    waiting.delete(message.id);
    if (then) then(message);
  } else if (message.type === 'event') {
    log(message.sim_s, message.text);
  }
}

function quiet() {
  document.body.classList.remove('stale');
  $('alarm').hidden = true;
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
