'use strict';
// What has happened, in words of the page's language.

const happened = [];  // As the server told of it, so that it can be told again in another language.

/// A condition's values as a person reads them: "Rain 6.0 mm/h, Wet road 60 %".
const condition_words = (values) => Object.entries(values).filter(([name]) => readings[name])
  .map(([name, value]) => `${t(`condition.${name}`)} ${readings[name].read(Number(value))}`).join(', ');

const kmh_of = (mps) => figure(3.6 * Math.abs(Number(mps)));

/// What an operator has done: "Pause", "Weather and light: Rain 6.0 mm/h".
function wish_words(values) {
  const { wish } = values;
  if (wish === 'conditions') return t('event.wish_conditions', { what: condition_words(values) });
  if (wish === 'trigger') return t('event.wish_trigger', { what: short_name(values.element || '') });
  return has_text(`event.wish_${wish}`) ? t(`event.wish_${wish}`, { x_m: '', y_m: '', part: '', thing: '', entity: '', vehicles: '', reason: '', seconds: '', ...values, what: has_text(`carfault.${values.what}`) ? t(`carfault.${values.what}`) : heard(values.what || '') })
    : [wish, ...Object.entries(values).filter(([name]) => name !== 'by' && name !== 'wish').map(([name, value]) => `${name.replaceAll('_', ' ')} ${value}`)].join(' ');
}

/// What a crash came to: each one's ΔV, and whence the blow came.
function crash_words(values) {
  const side = (before) => {
    const x = Number(values[`${before}delta_v_x_mps`]), y = Number(values[`${before}delta_v_y_mps`]), whence = Number(values[`${before}principal_direction_rad`]);
    if (!Number.isFinite(x + y + whence)) return '';
    const eighth = ((Math.round(whence / (Math.PI / 4)) % 8) + 8) % 8;
    return t('event.crash_side', { kmh: kmh_of(Math.hypot(x, y)), whence: t(`whence.${eighth}`) });
  };
  const sides = [side(''), side('its_')];
  const told = t('event.crash', { kmh: kmh_of(values.closing_speed_mps || 0), other: values.with ? values.what || values.with : heard((values.stands || '').replaceAll('_', ' ')) });
  return [told, sides[0], sides[1] && `${values.with}: ${sides[1]}`].filter(Boolean).join('; ');
}

function event_words({ kind, values = {}, text }) {
  const by = values.by ? ` (${values.by === 'operator' ? t('event.operator') : values.by})` : '';
  if (kind === 'message') return heard(text);
  if (kind === 'operator') return wish_words(values) + by;
  if (kind === 'mark') return t('event.mark', { note: values.note || '' }) + by;
  if (kind === 'word') return t('event.word', { text: values.text || '' }) + by;
  if (kind === 'call') return t('event.call', { what: [values.name, values.node, ...Object.entries(values).filter(([name]) => !['name', 'node', 'by'].includes(name)).map((pair) => pair.join(' '))].filter(Boolean).join(' ') }) + by;
  if (kind === 'rating') return t('event.rating', { value: values.value || '' }) + by;
  if (kind === 'collision') return t(values.what ? 'event.collision' : 'event.collision_somebody', { what: heard(values.what || ''), kmh: kmh_of(values.closing_speed_mps || 0) });
  if (kind === 'crash') return crash_words(values);
  if (kind === 'hazard') return t('event.hazard', { name: values.name || '' });
  if (kind === 'error_of_people') return error_words(values);
  if (kind === 'kerb') return t('event.kerb', { kmh: kmh_of(values.speed_mps || 0) });
  if (kind === 'wheel_damage') return t('event.wheel_damage', { wheel: t(`wheel.${values.wheel}`) });
  if (kind === 'lane_change') return t((values.lanes_to_left || '').startsWith('-') ? 'event.lane_change_right' : 'event.lane_change_left');
  if (kind === 'speed_limit') return values.kmh === '0' ? t('event.no_limit') : t('event.speed_limit', { kmh: values.kmh });
  if (kind === 'right_of_way') {
    if (values.kind === 'lights') return t('event.lights', { shows: heard(values.shows || '') });
    return t(values.kind === 'crossing' ? 'event.crossing' : 'event.give_way', { seconds: figure(Number(values.margin_s || 0), 1) });
  }
  if (kind === 'actuators_cut') return t('event.actuators_cut', { why: heard(values.why || '') });
  if (kind === 'no_sound') return t('event.no_sound', { device: heard(values.device), why: heard(values.why), remedy: heard(values.remedy) });
  if (kind === 'sound') return t('event.sound', { device: heard(values.device) });
  if (kind === 'emergency_stop') return t(values.pressed === '1' ? 'event.stop_pressed' : 'event.stop_released');
  return has_text(`event.${kind}`) ? t(`event.${kind}`) + by : text;
}

/// Somebody of the traffic errs, or his error is over.
function error_words(values) {
  if (values.refused) return heard(values.refused);
  const whom = values.whom === String(hello.driver) ? t('event.error_driver') : values.whom || '';
  if (values.ended === 'unmet') return t('event.error_unmet', { whom });
  return t(`event.error_${values.state}`, { what: t(`event.error_${values.kind}`, { whom }), seconds: figure(Number(values.lasted_s || 0), 1) });
}

/// `event`: as the server sends it; a text of the page's own has no time.
function log(event, is_mine) {
  const line = document.createElement('li'), time = document.createElement('time'), words = document.createElement('span');
  time.textContent = event.sim_s === undefined || event.sim_s === null ? t('shell.now') : `${figure(event.sim_s, 1)} s`;
  words.textContent = event.kind ? event_words(event) : event.text;
  if (is_mine || ['mark', 'operator', 'call', 'word', 'rating'].includes(event.kind)) words.className = 'mine';
  line.append(time, words);
  $('events').prepend(line);
  while ($('events').children.length > 300) $('events').lastChild.remove();
}

function tell_again() {
  $('events').replaceChildren();
  for (const event of happened) log(event);
}
