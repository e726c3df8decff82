// What is in the page: the description in element "model" (JSON), numbers in element "data" (base64); and its words and colours.
/* exported Page */
const Page = (function () {
  'use strict';
  const $ = id => document.getElementById(id);

  function decode(text) {
    const letters = atob(text), result = new Uint8Array(letters.length);
    for (let i = 0; i < letters.length; ++i) result[i] = letters.charCodeAt(i);
    return result;
  }
  function adler32(data) {
    let a = 1, b = 0;
    for (let i = 0; i < data.length; ++i) {
      a = (a + data[i]) % 65521;
      b = (b + a) % 65521;
    }
    return b * 65536 + a;
  }

  let model, bytes;
  try {
    model = JSON.parse($('model').textContent);
    const data = decode($('data').textContent);
    if (data.length !== model.bytes || adler32(data) !== model.adler32) throw new Error('changed');
    bytes = data.buffer;
  } catch (error) {
    window.pageFailed('This page cannot be shown: its data are damaged. Copy the file again, or make it anew with voxelcore.');
    return null;
  }

  const numbers = ([at, count, size]) =>
    size === 2 ? new Uint16Array(bytes, at, count) : new Uint32Array(bytes, at, count);

  // Places of a mesh's points relative to `middle`.
  function places(mesh, middle) {
    const codes = numbers(mesh.points), points = new Float32Array(codes.length);
    for (let i = 0; i < codes.length; ++i) {
      const k = i % 3;
      points[i] = mesh.low[k] - middle[k] + (mesh.high[k] - mesh.low[k]) * codes[i] / 65535;
    }
    return points;
  }

  // One number a point, NaN where there is none; null when the mesh has no such array.
  const known = new Map();
  function valuesOf(mesh, name) {
    if (!mesh.values[name]) return null;
    const key = mesh.values[name];
    if (!known.has(key)) {
      const { low, high } = model.ranges[name];
      known.set(key, Float32Array.from(numbers(key), q => q === 65535 ? NaN : low + (high - low) * q / 65534));
    }
    return known.get(key);
  }

  const names = { Radius: 'Radius', Lambda: 'Lambda', ErosionThickness: 'Erosion thickness', Thickness: 'Thickness', Confidence: 'Confidence', Label: model.groups || 'Label', Branch: 'Branch' };

  // The unit in which people read lengths of about this one.
  function unitFor(length) {
    const size = Math.abs(length);
    return size > 0 ? model.units.find(unit => size >= unit.from) : model.units[0];
  }
  // The same of an array's values, not all of which are lengths.
  const unitOf = (name, value) => name === 'Confidence' ? { size: 1, name: '' } : unitFor(value);
  // 1, 2 or 5 times a power of ten, the largest that is not above `value`.
  function roundDown(value) {
    const power = Math.pow(10, Math.floor(Math.log10(value)));
    return [5, 2, 1].map(f => f * power).find(s => s <= value * (1 + 1e-9)) || power;
  }
  const digits = value => String(+value.toPrecision(6));
  function valueText(value, unit, significant) {
    return String(+(value / unit.size).toPrecision(significant || 4)) + (unit.name ? ' ' + unit.name : '');
  }
  const lengthText = (length, significant) => valueText(length, unitFor(length), significant);

  // The colour map: `model.map` at equal steps.
  const map = model.map.map(code => [1, 3, 5].map(at => parseInt(code.substr(at, 2), 16)));
  function mapColor(t) {
    const at = Math.min(1, Math.max(0, t)) * (map.length - 1), i = Math.min(Math.floor(at), map.length - 2), f = at - i;
    return [0, 1, 2].map(k => map[i][k] + (map[i + 1][k] - map[i][k]) * f);
  }

  // A colour of its own for each branch: hues by the golden angle, so that those near each other in number differ.
  function branchColor(branch) {
    const hue = branch * 137.508 % 360, light = [0.42, 0.52, 0.34][branch % 3], a = 0.75 * Math.min(light, 1 - light);
    return [0, 8, 4].map(n => {
      const k = (n + hue / 30) % 12;
      return 255 * (light - a * Math.max(-1, Math.min(k - 3, 9 - k, 1)));
    });
  }

  return { $, model, numbers, places, valuesOf, names, unitFor, unitOf, roundDown, digits, valueText, lengthText, mapColor, branchColor };
})();
