'use strict';
// A lesson while it is driven: its tasks, the marks so far, and faults as they happen, each with what the screen ahead showed.

let lesson = null;  // The newest that was heard.
const stills = new Map();  // Fault → address of its picture.

function make_lesson() {
  $('lessonbox').hidden = !hello.lesson;
  $('drivemain').classList.toggle('taught', Boolean(hello.lesson));
  if (!hello.lesson) return;
  $('lessontitle').textContent = title_of({ scenario: hello.scenario, lesson: hello.lesson.title });
  $('lessonaim').textContent = heard(hello.lesson.aim);
  show_lesson();
}

function hear_lesson(message) {
  if (!hello || !hello.lesson) return;
  lesson = message;
  show_lesson();
}

/// Pictures come when they come: before their fault or after it.
function hear_still({ fault, picture }) {
  stills.set(fault, picture);
  const image = document.querySelector(`#faults li[data-number="${fault}"] img`);
  if (image) image.src = picture;
  if (image) image.parentNode.hidden = false;
}

function show_lesson() {
  const facts = hello.lesson, mark = lesson && lesson.mark !== null ? figure(lesson.mark, 1) : '–';
  $('lessonmark').textContent = mark;
  $('lessonpass').textContent = t('lesson.to_pass', { mark: figure(facts.pass_mark, 1) });
  $('lessonmark').className = lesson && lesson.mark !== null ? (lesson.passed ? 'good' : 'bad') : '';
  fill($('lessontasks'), facts.tasks.map((task, i) => {
    const now = lesson && lesson.tasks[i];
    return [heard(task.says), now && now.mark !== null ? figure(now.mark, 1) : t('severity.not_seen'), now && now.faults ? String(now.faults) : ''];
  }), (i) => lesson && lesson.tasks[i] ? `severity-${lesson.tasks[i].severity}` : '');
  const faults = lesson ? lesson.faults : [];
  const list = $('faults'), there = new Map([...list.children].map((item) => [Number(item.dataset.number), item]));
  for (const fault of faults) {
    const item = there.get(fault.number) || make_fault(fault);
    there.delete(fault.number);
    tell_fault(item, fault);
  }
  for (const item of there.values()) item.remove();  // What is no fault any more.
  $('nofaults').hidden = faults.length > 0;
}

/// The newest stands first.
function make_fault({ number }) {
  const item = document.createElement('li'), button = document.createElement('button'), image = new Image(), words = document.createElement('p');
  item.dataset.number = number;
  button.type = 'button';
  button.className = 'still';
  button.hidden = !stills.has(number);
  button.onclick = () => show_large(words.textContent, image.src);
  if (stills.has(number)) image.src = stills.get(number);
  button.append(image);
  item.append(button, words);
  $('faults').prepend(item);
  return item;
}

function tell_fault(item, fault) {
  const task = hello.lesson.tasks[fault.task], [button, words] = item.children;
  const digits = task.unit === 'km/h' ? 0 : 1;
  const measured = task.measure === 'collision' ? t('fault.collision', { value: figure(fault.worst) })
    : task.measure === 'limit' ? t('fault.limit', { value: figure(fault.worst) })
    : t(task.at_most ? 'fault.at_most' : 'fault.at_least', { value: figure(fault.worst, digits), bound: figure(task.bound, digits), unit: task.unit });
  const lasted_s = fault.to_s - fault.from_s;
  const when = lasted_s < 1 ? t('fault.at', { time: figure(fault.from_s, 1) }) : t('fault.from_for', { time: figure(fault.from_s, 1), seconds: figure(lasted_s) });
  const text = `${when} · ${task.says}: ${[measured, fault.at && place_words(fault.at)].filter(Boolean).join(', ')} (${t(`severity.${fault.severity}`)})`;
  if (words.textContent !== text) words.textContent = text;
  button.firstChild.alt = button.title = t('fault.still', { time: figure(fault.from_s, 1) });
  item.className = `severity-${fault.severity}`;
}

/// Where a fault was, as the server says it, in the page's language.
function place_words(at) {
  const limit = /^where (\d+) km\/h are allowed$/.exec(at);
  return limit ? t('fault.where_limit', { kmh: limit[1] }) : heard(at);
}
