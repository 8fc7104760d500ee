'use strict';
// Weather, light and grip: what can be set of them, and how it is read.

const degrees = (rad) => `${(rad * 180 / Math.PI).toFixed(0)}°`;
const percent = (share) => `${(100 * share).toFixed(0)} %`;
// How each condition is read; its label is the text condition.NAME. `bend` > 1 gives small values more of the slider.
const readings = {
  rain_mm_per_h: { read: (v) => `${figure(v, 1)} mm/h`, bend: 2 },
  road_wetness: { read: percent },
  snow_cover: { read: percent },
  visibility_m: { read: (v) => v < 2000 ? `${figure(v)} m` : `${figure(v / 1000, 1)} km`, bend: 4 },
  cloud_cover: { read: percent },
  temperature_k: { read: (v) => `${figure(v - 273.15, 1)} °C` },
  wind_speed_mps: { read: (v) => `${figure(v, 1)} m/s` },
  wind_direction_rad: { read: degrees },
  sun_elevation_rad: { read: degrees },
  sun_azimuth_rad: { read: degrees },
  sun_illuminance_lux: { read: (v) => `${figure(v)} lx`, bend: 3 },
  friction_scale: { read: percent },
};
const presets = {
  clear: 'rain_mm_per_h=0 road_wetness=0 snow_cover=0 visibility_m=20000 cloud_cover=0.2 temperature_k=288.15',
  rain: 'rain_mm_per_h=6 road_wetness=0.6 snow_cover=0 visibility_m=4000 cloud_cover=0.9 temperature_k=284.15',
  cloudburst: 'rain_mm_per_h=40 road_wetness=1 snow_cover=0 visibility_m=800 cloud_cover=1 temperature_k=284.15',
  fog: 'rain_mm_per_h=0 visibility_m=90 cloud_cover=1',
  snow: 'rain_mm_per_h=4 road_wetness=0.2 snow_cover=0.8 visibility_m=1500 cloud_cover=1 temperature_k=270.15',
  day: 'sun_elevation_rad=0.7 sun_illuminance_lux=80000',
  dusk: 'sun_elevation_rad=0.02 sun_illuminance_lux=1000',
  night: 'sun_elevation_rad=-0.4 sun_illuminance_lux=0',
};
const sliders = [];

function make_conditions() {
  $('presets').replaceChildren(...Object.entries(presets).map(([name, text]) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = t(`preset.${name}`);
    button.onclick = () => change(`conditions ${text}`);
    return button;
  }));
  sliders.length = 0;
  $('conditions').replaceChildren(...hello.conditions.map((condition) => {
    const known = readings[condition.name] || { read: (v) => figure(v, 2) }, label_key = `condition.${condition.name}`;
    const label = document.createElement('label'), name = document.createElement('span'), value = document.createElement('output');
    const slider = document.createElement('input');
    const bend = known.bend || 1, span = condition.most - condition.least;
    Object.assign(slider, { type: 'range', min: 0, max: 1000 });
    name.textContent = has_text(label_key) ? t(label_key) : condition.name;
    const read = () => condition.least + span * (slider.value / 1000) ** bend;
    slider.oninput = () => { value.textContent = known.read(read()); slider.held = performance.now(); };
    slider.onchange = () => { slider.held = performance.now(); change(`conditions ${condition.name}=${+read().toPrecision(4)}`); };
    label.append(name, slider, value);
    sliders.push((now) => {
      if (performance.now() - (slider.held || -1e9) < 1500) return;
      slider.value = 1000 * (Math.max(0, now - condition.least) / span) ** (1 / bend);
      value.textContent = known.read(now);
    });
    return label;
  }));
}
