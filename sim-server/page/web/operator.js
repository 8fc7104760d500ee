'use strict';
// What the operator does.

$('take').onclick = () => {
  if (mine) return ask({ do: 'release' }, show_command);
  ask({ do: 'take', name: $('name').value }, (answer) => {
    if (answer.ok) return;
    $('takingtext').textContent = t('taking.text', { name: (state.commander && state.commander.name) || t('shell.somebody') });
    $('taking').showModal();
  });
};
$('taking').onclose = () => { if ($('taking').returnValue === 'yes') ask({ do: 'take', name: $('name').value, by_force: true }, show_command); };
$('name').value = localStorage.getItem('name') || '';
$('name').onchange = () => {
  localStorage.setItem('name', $('name').value);
  if (mine) ask({ do: 'take', name: $('name').value }, show_command);
};
$('pause').onclick = () => command({ do: stands_still() ? 'go_on' : 'pause' });
$('rearm').onclick = () => command({ do: 'rearm' });
/// `stops`: it is the participant who does, which makes the drive a drop-out.
function offer_end(stops) {
  $('ending').returnValue = '';
  $('participantstops').checked = stops;
  $('ending').showModal();
}
$('end').onclick = () => offer_end(false);
$('ending').onclose = () => {
  const chosen = $('ending').returnValue;
  $('ending').returnValue = '';  // The word of one that was closed before may come after the next one's.
  if (chosen === 'yes') command({ do: 'end', reason: $('reason').value, participant_stops: $('participantstops').checked });
};
$('markform').onsubmit = (event) => {
  event.preventDefault();
  command({ do: 'mark', note: $('note').value });
  $('note').value = '';
};
$('wordform').onsubmit = (event) => {
  event.preventDefault();
  if (!$('word').value.trim()) return;
  command({ do: 'say', text: $('word').value, language, aloud: $('aloud').checked && hello.speaks });
  $('word').value = '';
};
$('commandform').onsubmit = (event) => {
  event.preventDefault();
  if ($('command').value.trim()) change($('command').value.trim());
};
$('trafficform').onsubmit = (event) => {
  event.preventDefault();
  change(`traffic vehicles=${Math.max(0, Math.min(3000, Math.round(+$('vehicles').value || 0)))}`);
};
$('guideform').onsubmit = (event) => {
  event.preventDefault();
  change(`to ${$('guide_to').value.trim() || 'nowhere'}`);
};
/// The map was clicked there: the chosen hazard waits for the driver in the lane nearest to there.
function set_hazard_at(x, y) {
  set_map_click(null);
  if ($('hazards').value) change(`hazard x_m=${+x.toFixed(2)} y_m=${+y.toFixed(2)} name=${$('hazards').value}`);
}
$('overlook').onclick = () => change('overlook');
