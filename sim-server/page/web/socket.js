'use strict';
// What is said to the server and heard of it: PROTOCOL.md beside the server's sources. With a drive `hello` and `state` are of that; without one
// `hello.choices` are what a drive is chosen from.
const token = location.hash.slice(1);
const silence_ms = 1000;  // Without a state for longer than that, what is shown is old.

let moved = false;  // Another program serves the page from now on.
let socket = null, hello = null, state = null, before = null;
let came_ms = 0, interval_ms = 100, number = 0, mine = false, refused = 0;
const waiting = new Map();  // Message number → what to do with its answer.

/// Beside the page, wherever below a proxy's host that is.
function live_address(page) {
  const address = new URL('live', page);
  address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:';
  address.hash = '';
  return address.href;
}

function connect() {
  let opened = false;
  try {
    socket = new WebSocket(live_address(location.href), ['septet', token]);
  } catch (error) {
    return alarm(t('shell.no_token'));
  }
  socket.onopen = () => { opened = true; refused = 0; };
  socket.onmessage = (message) => receive(JSON.parse(message.data));
  socket.onclose = () => {
    waiting.clear();
    mine = false;
    document.body.classList.add('stale');
    if (!opened) ++refused;
    const ended = state && state.phase && has_ended(state);
    if (moved) quiet();
    else if (ended) alarm(t('shell.has_ended', { why: why_ended(state) }));
    else if (refused > 1) alarm(t('shell.no_answer'));
    else alarm(t('shell.lost'));
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
  ask(what, (answer) => { if (!answer.ok) log({ text: t('shell.not_done', { why: heard(answer.why) }) }, true); });
}
/// A refusal of what bore no number that is waited for.
function hear_refusal(answer) {
  const text = t('shell.not_done', { why: heard(answer.why) });
  hello && hello.choices ? alarm(text) : log({ text }, true);
}
const change = (text) => command({ do: 'change', command: text });

function receive(message) {
  if (message.type === 'hello') {
    hello = message;
    state = before = null;
    happened.length = 0;
    lesson = null;
    stills.clear();
    $('faults').replaceChildren();
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
  } else if (message.type === 'large_picture') {
    show_large_picture(message);
  } else if (message.type === 'lesson') {
    hear_lesson(message);
  } else if (message.type === 'stock') {
    hear_stock(message);
  } else if (message.type === 'placed') {
    hear_placed(message);
  } else if (message.type === 'still') {
    hear_still(message);
  } else if (message.type === 'moved') {
    moved = true;
  } else if (message.type === 'answer') {
    const then = waiting.get(message.id);
    waiting.delete(message.id);
    if (then) then(message);
    else if (!message.ok) hear_refusal(message);
  } else if (message.type === 'event') {
    happened.push(message);
    if (happened.length > 300) happened.shift();
    log(message);
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
