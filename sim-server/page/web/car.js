'use strict';
// The driver's car in the instructor's hands: the second brake, back onto the road, faults.

const repeat_s = 30, brake_again_ms = 300;  // The server lets the brake go where it hears nothing for a second.
let braking = 0;  // The timer that says so again; 0: the brake is not held.

function hold_brake() {
  if (braking || !mine) return;
  const say = () => ask({ do: 'brake', held: true }, (answer) => {
    if (!answer.ok) { let_go_brake(); log({ text: t('shell.not_done', { why: heard(answer.why) }) }, true); }
  });
  braking = setInterval(say, brake_again_ms);
  say();
}

function let_go_brake() {
  if (!braking) return;
  clearInterval(braking);
  braking = 0;
  ask({ do: 'brake', held: false }, () => {});
}

const brake_button = $('instructorbrake');
brake_button.onpointerdown = (event) => { brake_button.setPointerCapture(event.pointerId); hold_brake(); };
brake_button.onpointerup = brake_button.onpointercancel = brake_button.onlostpointercapture = brake_button.onblur = let_go_brake;
brake_button.onkeydown = (event) => { if (event.key === ' ' || event.key === 'Enter') { event.preventDefault(); hold_brake(); } };
brake_button.onkeyup = let_go_brake;
brake_button.oncontextmenu = (event) => event.preventDefault();  // A long touch.
addEventListener('blur', let_go_brake);
document.addEventListener('visibilitychange', () => { if (document.hidden) let_go_brake(); });

$('back').onclick = () => command({ do: 'back', seconds: 0 });
$('repeat').onclick = () => command({ do: 'back', seconds: repeat_s });

$('restartform').onsubmit = (event) => { event.preventDefault(); command({ do: 'restart', at_s: +$('restartat').value }); };

/// The start and the times of kept states, newest first. The newest stays chosen until another one is.
function show_restart() {
  if (!hello.restart || state.sim_s === undefined) return;
  const { from_s, every_s } = hello.restart, choice = $('restartat');
  const times = [0];
  for (let at_s = from_s > 0 ? from_s : every_s; at_s <= state.sim_s; at_s += every_s) times.push(at_s);
  if (choice.options.length === times.length) return;
  const chosen = choice.selectedIndex > 0 ? choice.value : null;
  choice.replaceChildren(...times.reverse().map((at_s) => option(at_s, `${at_s} s`)));
  if (chosen !== null) choice.value = chosen;
}

/// The map was clicked there: the car stands in the nearest lane that runs as it heads.
function put_at(x, y) {
  set_map_click(null);
  const own = (state.everybody || []).find((other) => other[0] === hello.driver);
  change(`put x_m=${+x.toFixed(2)} y_m=${+y.toFixed(2)} heading_rad=${own ? own[4] : 0} speed_mps=0`);
}

function make_car() {
  $('restartform').hidden = !hello.restart;
  $('restartat').replaceChildren();
  $('repeat').textContent = t('controls.repeat', { seconds: repeat_s });
  set_map_click(null);
  $('carfaults').replaceChildren(...hello.faults.map((name, i) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = t(`carfault.${name}`);
    button.onclick = () => change(`${state.faults[i] ? 'repair' : 'fault'} what=${name}`);
    return button;
  }));
}

function show_car() {
  show_restart();
  brake_button.setAttribute('aria-pressed', String(Boolean(state.instructor_brakes)));
  [...$('carfaults').children].forEach((button, i) => button.setAttribute('aria-pressed', String(Boolean(state.faults[i]))));
  $('faultsbox').classList.toggle('due', state.faults.some(Boolean));
}
