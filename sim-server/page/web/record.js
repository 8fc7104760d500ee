'use strict';
// A student's record: marks and faults of all his drives, the oldest first.

const signs = { none: '✓', minor: '•', serious: '▲', dangerous: '✖' };
const most_columns = 12;  // The newest lessons, of faults.

function svg_element(name, attributes, text) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text) made.textContent = text;
  return made;
}

/// Marks of 10, evenly spaced: filled where the lesson was passed. What it shows is told in words, too.
function draw_marks(marked) {
  const left = 34, right = 620, top = 14, bottom = 170;
  const x = (i) => marked.length < 2 ? (left + right) / 2 : left + 20 + i * (right - left - 40) / (marked.length - 1);
  const y = (mark) => bottom - mark / 10 * (bottom - top);
  const parts = [];
  for (const mark of [0, 2, 4, 6, 8, 10])
    parts.push(svg_element('line', { x1: left, x2: right, y1: y(mark), y2: y(mark), class: 'grid' }),
               svg_element('text', { x: left - 8, y: y(mark) + 4, class: 'left' }, String(mark)));
  if (marked.length) {
    parts.push(svg_element('polyline', { points: marked.map((one, i) => `${x(i)},${y(one.mark)}`).join(' '), class: 'marks' }));
    marked.forEach((one, i) => {
      const dot = svg_element('circle', { cx: x(i), cy: y(one.mark), r: 6, class: one.passed ? 'passed' : 'failed' });
      dot.append(svg_element('title', {}, `${local_time(one.started_utc)}: ${title_of(one)}, ${result_of(one)}`));
      parts.push(dot);
    });
    parts.push(svg_element('text', { x: x(0), y: 192, class: 'middle' }, local_day(marked[0].started_utc)));
    if (marked.length > 1) parts.push(svg_element('text', { x: x(marked.length - 1), y: 192, class: 'middle' }, local_day(marked.at(-1).started_utc)));
  } else parts.push(svg_element('text', { x: (left + right) / 2, y: 95, class: 'middle' }, t('record.no_marks')));
  $('recordchart').setAttribute('aria-label', marked.map((one) => `${local_day(one.started_utc)}: ${result_of(one)}`).join('; ') || t('record.no_marks'));
  $('recordchart').replaceChildren(...parts);
}

const cell_of = (name, text, title) => {
  const cell = document.createElement(name);
  cell.textContent = text;
  if (title) cell.title = title;
  return cell;
};

/// A row a task, a column a lesson: how badly it went wrong.
function show_faults(lessons) {
  const shown = lessons.slice(-most_columns), table = $('recordfaults');
  const tasks = [...new Set(shown.flatMap((one) => one.tasks.map((task) => task.says)))];
  const head = document.createElement('tr');
  head.append(cell_of('th', t('record.task')), ...shown.map((one) => cell_of('th', local_day(one.started_utc), title_of(one))), cell_of('th', t('record.with_fault')));
  table.tHead.replaceChildren(head);
  table.tBodies[0].replaceChildren(...tasks.map((says) => {
    const row = document.createElement('tr');
    row.append(cell_of('th', heard(says)));
    let seen = 0, wrong = 0;
    for (const one of shown) {
      const task = one.tasks.find((other) => other.says === says), is_seen = Boolean(task && task.mark !== null);
      seen += is_seen;
      wrong += is_seen && task.severity !== 'none';
      const severity = is_seen ? t(`severity.${task.severity}`) : task ? t('severity.not_seen') : '';
      const cell = cell_of('td', is_seen ? signs[task.severity] || '?' : task ? '–' : '', severity);
      cell.setAttribute('aria-label', severity);
      cell.className = is_seen ? task.severity : '';
      row.append(cell);
    }
    row.append(cell_of('td', t('record.of_lessons', { count: wrong, all: seen })));
    return row;
  }));
  table.hidden = !tasks.length;
}

function show_record(participant) {
  const drives = state.sessions.filter((session) => session.participant === participant).sort((a, b) => a.started_utc < b.started_utc ? -1 : 1);
  const lessons = drives.filter((session) => session.lesson && session.taken), marked = lessons.filter((session) => session.mark !== null);
  $('recordtitle').textContent = t('record.title', { participant });
  $('recordabout').textContent = drives.length ? t('record.about', { drives: drives.length, first: local_day(drives[0].started_utc), last: local_day(drives.at(-1).started_utc),
    passed: marked.filter((session) => session.passed).length, marked: marked.length }) : '';
  draw_marks(marked);
  show_faults(lessons);
  $('recorddrives').replaceChildren(...drives.map((session) => {
    const faults = session.tasks.filter((task) => task.mark !== null && task.severity !== 'none').map((task) => `${t(`severity.${task.severity}`)}: ${heard(task.says)}`);
    const line = cell_of('li', `${local_time(session.started_utc)} · ${title_of(session)} · ${result_of(session) || end_of(session)}`);
    if (session.lesson && session.taken) line.append(cell_of('p', faults.join('; ') || t('record.no_faults')));
    if (session.has_debrief) line.append(row_button(t('past.debrief'), 'file', () => look(session.id, 'debrief.html')));
    return line;
  }));
  if (!$('record').open) $('record').showModal();
}

$('recordclose').onclick = () => $('record').close();
