'use strict';
// The screens of the rig, and who is near the driver.

const rates = new Map();  // Screen → pictures counted lately.

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
    return [screen.live ? screen.name : t('screens.away', screen), rate.toFixed(1), screen.live ? `${screen.frame_ms.toFixed(0)} ms` : '–',
            screen.behind_ms === null ? '–' : `${screen.behind_ms.toFixed(0)} ms`, String(screen.lost), String(screen.drop_outs)];
  });
  fill($('screens'), rows.length ? rows : [[t('screens.none'), '', '', '', '', '']],
       (i) => state.screens[i] && !state.screens[i].live ? 'away' : '');
}

function show_near() {
  const all = state.everybody || [], own = all.find((p) => p[0] === hello.driver);
  if (!own) return;
  const rows = all.filter((p) => p !== own).map((p) => [Math.hypot(p[2] - own[2], p[3] - own[3]), p]).sort((a, b) => a[0] - b[0]).slice(0, 8)
    .map(([away, p]) => [`${hello.models[p[1]].name} ${p[0]}`, `${away.toFixed(0)} m`, (3.6 * p[5]).toFixed(0)]);
  fill($('near'), rows);
}

/// A small picture of what a screen shows, once a second. Browsers read the bytes, nobody before them: what is no picture is not shown.
function show_thumbnail({ screen, picture }) {
  const name = `thumbnail ${screen}`;
  let figure = [...$('thumbnails').children].find((one) => one.dataset.name === name);
  if (!figure) {
    figure = document.createElement('figure');
    figure.dataset.name = name;
    const caption = document.createElement('figcaption'), button = document.createElement('button');
    caption.textContent = screen;
    button.type = 'button';
    button.className = 'still';
    button.title = t('screens.large', { screen });
    button.onclick = () => watch(screen);
    button.append(new Image());
    button.firstChild.alt = t('screens.shows', { screen });
    figure.append(button, caption);
    $('thumbnails').append(figure);
  }
  figure.querySelector('img').src = picture;
  figure.dataset.came = String(performance.now());
}

/// One that no new picture has come of is shown as old. They stand in the rig's order, whichever came first.
function age_thumbnails() {
  const place = (figure) => state.screens.findIndex((screen) => figure.dataset.name === `thumbnail ${screen.name}`);
  const figures = [...$('thumbnails').children], sorted = [...figures].sort((a, b) => place(a) - place(b));
  if (sorted.some((figure, i) => figure !== figures[i])) $('thumbnails').append(...sorted);
  for (const figure of $('thumbnails').children) figure.classList.toggle('old', performance.now() - figure.dataset.came > 5000 && !state.paused);
}

let watched = '';  // The screen that is shown large, as it goes on; empty: none.

function show_large(title, picture) {
  $('largetitle').textContent = title;
  $('large').src = picture;
  $('large').alt = title;
  if (!$('largebox').open) $('largebox').showModal();
}

/// What a screen shows, large, five times a second as long as the picture is open.
function watch(screen) {
  watched = screen;
  const small = [...$('thumbnails').children].find((one) => one.dataset.name === `thumbnail ${screen}`);
  show_large(screen, small ? small.querySelector('img').src : '');
  ask({ do: 'watch', screen }, () => {});
}

function show_large_picture({ screen, picture }) {
  if (screen === watched) $('large').src = picture;
}

$('largebox').onclose = () => {
  if (watched) ask({ do: 'watch', screen: '' }, () => {});
  watched = '';
};
$('large').onclick = () => $('largebox').close();
