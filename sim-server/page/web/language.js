'use strict';
// The page in the language of who reads it. Each file language_XX.js has the same keys; an element's data-t is the key of its text,
// data-t-title, data-t-label and data-t-placeholder those of its attributes. Words of the server that have a key "said.WORDS" are told likewise;
// a {name} in such a key stands for anything, and {why} for another such sentence.
const languages = {};
const $ = (id) => document.getElementById(id);
let language = 'en';

/// The text of a key, with {name} replaced by values.name.
function t(key, values = {}) {
  const text = (languages[language] || {})[key] ?? languages.en[key] ?? key;
  return text.replace(/\{(\w+)\}/g, (all, name) => name in values ? String(values[name]) : all);
}
const has_text = (key) => key in languages.en;

/// Keys of sentences with gaps, each with the expression that finds what fills them; the longest first, which says most.
let gapped = null;
function sentences_with_gaps() {
  gapped ??= Object.keys(languages.en).filter((key) => key.startsWith('said.') && key.includes('{')).sort((a, b) => b.length - a.length).map((key) => {
    const form = key.slice(5).replace(/[.*+?^$()|[\]\\]/g, '\\$&').replace(/\{(\w+)\}/g, '(?<$1>.+?)');
    return [key, new RegExp(`^${form}$`)];
  });
  return gapped;
}

/// What the server has said, in this language where it is one of the sentences that the page knows.
function heard(text) {
  if (has_text(`said.${text}`)) return t(`said.${text}`);
  for (const [key, form] of sentences_with_gaps()) {
    const found = form.exec(text);
    if (found) return t(key, found.groups.why ? { ...found.groups, why: heard(found.groups.why) } : found.groups);
  }
  return text;
}

/// A number as this language writes it.
function figure(value, digits = 0) {
  return new Intl.NumberFormat(language, { minimumFractionDigits: digits, maximumFractionDigits: digits, useGrouping: false }).format(value);
}

/// All elements of the page's own that hold words.
function show_words() {
  document.documentElement.lang = language;
  for (const element of document.querySelectorAll('[data-t]')) element.textContent = t(element.dataset.t);
  for (const [from, attribute] of [['data-t-title', 'title'], ['data-t-label', 'aria-label'], ['data-t-placeholder', 'placeholder']])
    for (const element of document.querySelectorAll(`[${from}]`)) element.setAttribute(attribute, t(element.getAttribute(from)));
}

/// Everything anew in another language. What was made from a message is made again from the same one.
function speak(chosen) {
  language = languages[chosen] ? chosen : 'en';
  show_words();
  for (const element of document.querySelectorAll('[data-key]')) delete element.dataset.key;
  if (!hello) return;
  if (hello.choices) make_start(); else make_drive();
  if (state) hello.choices ? show_start() : show_state();
}

/// The language that was chosen here before, else the first of the browser's that there is.
function first_language() {
  const wished = [localStorage.getItem('language'), ...navigator.languages.map((one) => one.slice(0, 2))];
  return wished.find((one) => one && languages[one]) || 'en';
}

function make_language() {
  $('language').replaceChildren(...Object.keys(languages).map((code) => new Option(languages[code]['language.name'], code)));
  $('language').value = first_language();
  $('language').onchange = () => {
    localStorage.setItem('language', $('language').value);
    speak($('language').value);
  };
  speak($('language').value);
}
