'use strict';
// Weather, light and grip: what can be set of them, and how it is read.

const degrees = (rad) => `${(rad * 180 / Math.PI).toFixed(0)}°`;
const percent = (share) => `${(100 * share).toFixed(0)} %`;
// How each condition is called and read; `bend` > 1 gives small values more of the slider.
const words = {
  rain_mm_per_h: { label: 'Rain, snowfall', read: (v) => `${v.toFixed(1)} mm/h`, bend: 2 },
  road_wetness: { label: 'Wet road', read: percent },
  snow_cover: { label: 'Snow on road', read: percent },
  visibility_m: { label: 'Fog: sight', read: (v) => v < 2000 ? `${v.toFixed(0)} m` : `${(v / 1000).toFixed(1)} km`, bend: 4 },
  cloud_cover: { label: 'Clouds', read: percent },
  temperature_k: { label: 'Temperature', read: (v) => `${(v - 273.15).toFixed(1)} °C` },
  wind_speed_mps: { label: 'Wind', read: (v) => `${v.toFixed(1)} m/s` },
  wind_direction_rad: { label: 'Wind towards', read: degrees },
  sun_elevation_rad: { label: 'Sun’s height', read: degrees },
  sun_azimuth_rad: { label: 'Sun’s bearing', read: degrees },
  sun_illuminance_lux: { label: 'Sunlight', read: (v) => `${v.toFixed(0)} lx`, bend: 3 },
  friction_scale: { label: 'Grip', read: percent },
};
const presets = {
  'Clear': 'rain_mm_per_h=0 road_wetness=0 snow_cover=0 visibility_m=20000 cloud_cover=0.2 temperature_k=288.15',
  'Rain': 'rain_mm_per_h=6 road_wetness=0.6 snow_cover=0 visibility_m=4000 cloud_cover=0.9 temperature_k=284.15',
  'Cloudburst': 'rain_mm_per_h=40 road_wetness=1 snow_cover=0 visibility_m=800 cloud_cover=1 temperature_k=284.15',
  'Fog': 'rain_mm_per_h=0 visibility_m=90 cloud_cover=1',
  'Snow': 'rain_mm_per_h=4 road_wetness=0.2 snow_cover=0.8 visibility_m=1500 cloud_cover=1 temperature_k=270.15',
  'Day': 'sun_elevation_rad=0.7 sun_illuminance_lux=80000',
  'Dusk': 'sun_elevation_rad=0.02 sun_illuminance_lux=1000',
  'Night': 'sun_elevation_rad=-0.4 sun_illuminance_lux=0',
};
const sliders = [];

function make_conditions() {
  $('presets').replaceChildren(...Object.entries(presets).map(([name, text]) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = name;
    button.onclick = () => change(`conditions ${text}`);
    return button;
  }));
  sliders.length = 0;
  $('conditions').replaceChildren(...hello.conditions.map((condition) => {
    const known = words[condition.name] || { label: condition.name, read: (v) => v.toFixed(2) };
    const label = document.createElement('label'), name = document.createElement('span'), value = document.createElement('output');
    const slider = document.createElement('input');
    const bend = known.bend || 1, span = condition.most - condition.least;
    Object.assign(slider, { type: 'range', min: 0, max: 1000 });
    name.textContent = known.label;
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
