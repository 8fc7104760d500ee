'use strict';
// Past drives: a list that can be searched, with marks and points, in the time of who reads it.

const local_time = (utc) => {
  const when = new Date(utc);
  return Number.isNaN(when.getTime()) ? utc : new Intl.DateTimeFormat(language, { dateStyle: 'medium', timeStyle: 'short' }).format(when);
};
const local_day = (utc) => {
  const when = new Date(utc);
  return Number.isNaN(when.getTime()) ? utc : new Intl.DateTimeFormat(language, { dateStyle: 'short' }).format(when);
};

/// A lesson by its title, else the scenario; in this language where Septet came with it.
function title_of(session) {
  const key = `scenario.${session.scenario}`;
  return has_text(key) ? t(key) : session.lesson || session.scenario;
}

/// Mark and outcome of a lesson, points of a game; empty where there is neither.
function result_of(session) {
  if (session.lesson) {
    if (!session.taken) return t('past.too_short');
    if (session.mark === null) return t('severity.not_seen');
    return `${t('past.mark_of_ten', { mark: figure(session.mark, 1) })}, ${t(session.passed ? 'past.passed' : 'past.not_passed')}`;
  }
  return session.points === null ? '' : `${t('past.points', { points: figure(session.points) })}, ${t('past.level', session)}`;
}

const end_of = (session) => has_text(`end.${session.ended}`) ? t(`end.${session.ended}`) : session.ended.replaceAll('_', ' ');

/// Every word that is typed stands somewhere in what the row says, or in its note.
function is_wanted(session) {
  const which = $('pastwhich').value;
  if ((which === 'lessons' && !session.lesson) || (which === 'games' && session.points === null) || (which === 'people' && session.driver)) return false;
  const text = [local_time(session.started_utc), session.started_utc.slice(0, 10), title_of(session), session.scenario, session.participant,
                session.driver || t('past.a_person'), session.rig, session.note, end_of(session), result_of(session), session.folder].join(' ').toLowerCase();
  return $('pastsearch').value.toLowerCase().split(/\s+/).every((word) => text.includes(word));
}

function row_button(text, name, does) {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = text;
  button.className = name;
  button.onclick = does;
  return button;
}

function session_row(session) {
  const row = document.createElement('tr');
  const cell = (label, text, title) => {
    const made = row.insertCell();
    made.textContent = text;
    made.dataset.label = label && t(label);
    if (title) made.title = title;
    return made;
  };
  cell('past.started', local_time(session.started_utc), session.folder);
  cell('past.drive', title_of(session), [session.scenario, session.rig, session.note].filter(Boolean).join(' · '));
  const who = cell('past.participant', session.participant ? '' : '–');
  if (session.participant) {
    who.append(row_button(session.participant, 'who', () => show_record(session.participant)));
    who.firstChild.title = t('record.title', session);
  }
  cell('past.mark', result_of(session) || '–').className = session.lesson && session.taken ? (session.passed ? 'good' : 'bad') : '';
  cell('past.driver', session.driver || t('past.a_person'));
  cell('past.driven', [session.simulated_s ? `${figure(session.simulated_s)} s` : '', end_of(session)].filter(Boolean).join(', '));
  const files = cell('', '');
  files.className = 'buttons';
  for (const [file, name, is_there] of [['report.html', t('past.report'), session.has_report], ['debrief.html', t('past.debrief'), session.has_debrief]])
    if (is_there) files.append(row_button(name, 'file', () => look(session.id, file)));
  if (session.has_film) files.append(row_button(t('past.film'), 'file', () => look(session.id, 'film.mp4')));
  for (const [what, name] of [['film', session.has_film ? t('past.film_anew') : t('past.make_film')], ['replay', t('past.replay')]])
    files.append(row_button(name, `make ${what}`, () => make_of(session.id, what)));
  if (hello.choices.questionnaires.length) files.append(row_button(t('past.questionnaire'), 'questionnaire', () => ask_driver(session)));
  if (session.answered.length) {
    const answered = document.createElement('p');
    answered.className = 'quiet';
    answered.textContent = t('past.answered', { names: session.answered.join(', ') });
    files.append(answered);
  }
  return row;
}

/// A film, or a replay on the screens of the server's machine.
function make_of(session, what) {
  ask({ do: 'make', session, what }, (answer) => { if (!answer.ok) alarm(heard(answer.why)); });
}

function show_work() {
  const work = state.work, session = work && state.sessions.find((one) => one.id === work.session);
  $('pastwork').hidden = !work;
  if (!work) return;
  const how = t(work.running ? 'past.work_running' : work.failed ? 'past.work_failed' : 'past.work_over');
  $('pastworktext').textContent = `${t(work.what === 'film' ? 'past.work_film' : 'past.work_replay', { drive: session ? `${title_of(session)}, ${local_time(session.started_utc)}` : '' })}: ${[how, work.said].filter(Boolean).join(' · ')}`;
  $('pastworkstop').hidden = !work.running;
}

function show_sessions() {
  show_work();
  const wanted = state.sessions.filter(is_wanted), body = $('sessions'), key = JSON.stringify(wanted);
  $('pastlooking').hidden = !state.looking;
  $('pastlooking').textContent = t('past.looking', { count: state.sessions.length });
  $('nosessions').hidden = wanted.length > 0 || (state.looking && !state.sessions.length);
  $('nosessions').textContent = t(state.sessions.length ? 'past.none_match' : 'past.none');
  if (body.dataset.key === key) return;
  body.dataset.key = key;
  body.replaceChildren(...wanted.map(session_row));
  const codes = [...new Set(state.sessions.map((session) => session.participant).filter(Boolean))].sort();
  $('participants').replaceChildren(...codes.map((code) => new Option(code)));
}

/// A report in a tab of its own. That is opened at once, or the browser takes it for a pop-up.
function look(id, file) {
  const tab = window.open('about:blank');
  ask({ do: 'look', session: id, file }, (answer) => {
    if (answer.ok && tab) tab.location = new URL(answer.path, location.href);
    else {
      if (tab) tab.close();
      alarm(answer.why ? heard(answer.why) : t('past.no_tab'));
    }
  });
}

$('pastworkstop').onclick = () => ask({ do: 'stop_making' }, () => {});
$('pastform').onsubmit = (event) => event.preventDefault();
$('pastsearch').oninput = $('pastwhich').onchange = show_sessions;
