// The page: a scan in, what it is, what is wanted; the program in a worker; results out.

import { zipSync } from 'fflate';
import { configure, readVtp, run, table, VoxelCoreError, voxels } from 'voxelcore';

import { Form } from './form.js';
import { colorOf, pageModel, pageOf, rangeOf } from './model.js';
import { part, textPart } from './parts.js';
import { certificateWords, histogramOf, tableOf } from './results.js';
import { baseOf, filesOfDrop, filesOfInput, scansAmong } from './scans.js';
import { Slices } from './slices.js';

const $ = (id) => document.getElementById(id);
const number = (value) => value.toLocaleString('en', { maximumSignificantDigits: 5 });

// What can be had, and the files each command writes besides its report.
const wanted = {
  core: 'Medial surface',
  skeleton: 'Curve skeleton',
  thickness: 'Local thickness',
  sheets: 'Sheets and rods',
  roots: 'Roots told apart',
};
const outputs = {
  core: (base) => ['-o', `${base}_core.vtp`, '--report', `${base}_core.json`, '--table', `${base}_core.csv`],
  skeleton: (base) => [
    '-o',
    `${base}_skeleton.vtp`,
    '--report',
    `${base}_skeleton.json`,
    '--table',
    `${base}_skeleton.csv`,
  ],
  thickness: (base) => [
    '-o',
    `${base}_thickness.nrrd`,
    '--report',
    `${base}_thickness.json`,
    '--table',
    `${base}_thickness.csv`,
    '--medial',
    `${base}_thickness.vtp`,
  ],
  sheets: (base) => ['-o', `${base}_sheets.vtp`, '--report', `${base}_sheets.json`, '--table', `${base}_sheets.csv`],
  roots: (base) => ['-o', `${base}_roots`, '--no-pictures'],
};
const people = { Vessel: 'Vessel or airway', Root: 'Root', Bone: 'Bone', Brain: 'Brain region', Default: 'Other' };

let files = []; // {name, data} as dropped
let labels = []; // of the scan that was read
let unit = 'mm'; // of its lengths; vox: they are in voxels
let reading; // AbortController of what is read or computed
let running;
let form;
let presets;
let viewerTemplate;
let lengthColors;
let results = {}; // files by name
let drawn = []; // meshes of the result: {kind, mesh}
let voxel = 0; // least spacing of the scan
let edits = { all: [], table: '' }; // of its skeleton, made in the viewer

const viewer = $('viewer');
const slices = new Slices($('slices'), (place) => viewer.contentWindow?.postMessage({ place, isChosen: true }, '*'));
window.addEventListener('message', ({ source, data }) => {
  if (source !== viewer.contentWindow) return;
  if (data.place) slices.goTo(data.place);
  if (data.ready && slices.scan) viewer.contentWindow.postMessage({ place: slices.place() }, '*');
  if (data.ready) viewer.contentWindow.postMessage({ edits: edits.all }, '*');
  if (data.edits) edits = { all: data.edits, table: data.table };
  if (data.apply) {
    $('want-skeleton').checked = true;
    $('work').requestSubmit();
  }
});

// ---- words ----
function say(sentence) {
  $('said').textContent = sentence;
}
function fail(error) {
  const lines =
    error instanceof VoxelCoreError && error.errors.length > 0 ? error.errors : [error.message ?? String(error)];
  $('failure').textContent = lines.map((line) => line.replace(/^voxelcore: /, '')).join('\n');
  $('failure').hidden = false;
  $('failure').scrollIntoView({ block: 'nearest' });
  say('');
}
function calm() {
  $('failure').hidden = true;
}

// ---- the scan ----
const mainFile = () => $('main-file').value;
const asRead = () => form.argumentsOf('info', 'Input'); // a threshold, a spacing, ...

async function take(dropped) {
  if (dropped.length === 0) return;
  files = dropped;
  const scans = scansAmong(files);
  $('main-file').textContent = '';
  for (const name of scans) $('main-file').add(new Option(name, name));
  $('which').hidden = $('main-file').options.length < 2;
  await look();
}

function showLabels() {
  const body = $('labels').tBodies[0];
  body.textContent = '';
  const rows = document.createDocumentFragment();
  for (const label of labels) {
    const row = document.createElement('tr');
    const name = document.createElement('label');
    label.box = Object.assign(document.createElement('input'), { type: 'checkbox', checked: true });
    name.append(label.box, label.name === `label-${label.label}` ? label.name : `${label.name} (${label.label})`);
    row.insertCell().append(name);
    for (const text of [`${number(label[`volume_${unit}3`])} ${unit}³`, label.voxels.toLocaleString('en')]) {
      Object.assign(row.insertCell(), { className: 'n', textContent: text });
    }
    label.row = row;
    rows.append(row);
  }
  body.append(rows);
  $('labels-part').hidden = false;
  for (const id of ['find-label', 'all-labels', 'no-labels']) $(id).hidden = labels.length < 8;
}

async function look() {
  reading?.abort();
  running?.abort();
  calm();
  $('run').disabled = true;
  labels = [];
  drawn = [];
  edits = { all: [], table: '' };
  slices.hide();
  $('labels-part').hidden = $('diagnosis').hidden = $('words').hidden = true;
  $('words').open = false;
  $('what').textContent = `Reading ${mainFile()} …`;
  reading = new AbortController();
  const { signal } = reading;
  try {
    const info = JSON.parse((await program(['info', '--json', ...asRead()], ['--', mainFile()], { signal })).text);
    ({ labels } = info);
    unit = info.spacing_mm ? 'mm' : 'vox';
    voxel = Math.min(...info[`spacing_${unit}`]);
    $('what').textContent =
      `${info.format}, ${info.pixel_type}: ${info.size.join(' × ')} voxels of ` +
      `${info[`spacing_${unit}`].map((side) => number(side)).join(' × ')} ${unit}; ` +
      `${labels.length} ${labels.length === 1 ? 'label' : 'labels'}.`;
    const unusual = [...info.warnings, ...info.notes];
    $('diagnosis').replaceChildren(
      ...unusual.map((line) => Object.assign(document.createElement('li'), { textContent: line })),
    );
    $('diagnosis').hidden = unusual.length === 0;
    showLabels();
    $('words').hidden = false;
    $('run').disabled = false;
    showSlices(info, signal);
  } catch (error) {
    if (signal.aborted) return;
    $('what').textContent = '';
    labels = [];
    fail(error);
  }
}

const nameOfLabel = (label) => labels.find((one) => one.label === label)?.name ?? `label-${label}`;
/** One color for a label in slices and in three dimensions: by its place among all. */
function labelColor(label) {
  const at = labels.findIndex((one) => one.label === label);
  return colorOf(at < 0 ? labels.length : at);
}

/** While the scan is thought about, and beside what is computed of it. */
async function showSlices(info, signal) {
  slices.tell('Reading the slices …');
  try {
    const scan = await voxels([...asRead(), '--', mainFile()], given(), { signal });
    if (signal.aborted) return;
    if (!scan) {
      slices.hide();
      return;
    }
    // as the pages that the program writes have it
    const isAnatomical =
      /^(NRRD|NIfTI|MetaImage)/.test(info.format) && !info.notes.some((note) => note.includes('taken as LPS'));
    slices.show(scan, { nameOf: nameOfLabel, colorOf: labelColor, isAnatomical });
    slices.outline(drawn);
  } catch (error) {
    if (!signal.aborted) slices.tell(`No slices: ${error.message.replace(/^voxelcore: /, '')}`);
  }
}

const editsFile = 'edits.csv';
const given = () => files.map(({ name, data }) => [name, data]);
const program = (before, after, how, more = []) => run([...before, ...after], [...given(), ...more], how);

$('words').addEventListener('toggle', async () => {
  if (!$('words').open) return;
  const place = $('words').querySelector('pre');
  place.textContent = '…';
  try {
    place.textContent = (await program(['info', ...asRead()], ['--', mainFile()], { signal: reading.signal })).text;
  } catch (error) {
    if (!reading.signal.aborted) place.textContent = error.message;
  }
});

// ---- drop and choice ----
for (const name of ['dragenter', 'dragover']) {
  document.addEventListener(name, (event) => {
    event.preventDefault();
    $('drop').classList.add('over');
  });
}
document.addEventListener('dragleave', (event) => {
  if (!event.relatedTarget) $('drop').classList.remove('over');
});
document.addEventListener('drop', async (event) => {
  event.preventDefault();
  $('drop').classList.remove('over');
  await take(
    await filesOfDrop(event.dataTransfer).catch((error) => {
      fail(error);
      return [];
    }),
  );
});
$('choose').addEventListener('click', () => $('files').click());
$('choose-folder').addEventListener('click', () => $('folder').click());
for (const id of ['files', 'folder']) {
  $(id).addEventListener('change', () => {
    take(filesOfInput($(id)));
    $(id).value = ''; // the same file again is a choice, too
  });
}
$('sample').addEventListener('click', async () => {
  await take([{ name: 'sample-root.nrrd', data: new File([await part('sample-root.nrrd')], 'sample-root.nrrd') }]);
});
$('main-file').addEventListener('change', look);

$('find-label').addEventListener('input', () => {
  const words = $('find-label')
    .value.toLowerCase()
    .split(/\s+/)
    .filter((word) => word);
  for (const { row, name, label } of labels) {
    row.hidden = !words.every((word) => name.toLowerCase().includes(word) || String(label) === word);
  }
});
for (const [id, checked] of [
  ['all-labels', true],
  ['no-labels', false],
]) {
  $(id).addEventListener('click', () => {
    for (const label of labels) if (!label.row.hidden) label.box.checked = checked;
  });
}

// ---- what is wanted ----
const chosenCommands = () => Object.keys(wanted).filter((command) => $(`want-${command}`).checked);

function choosePreset(name) {
  const { text, steps } = presets[name];
  $('preset-text').textContent = text;
  for (const command of Object.keys(wanted)) {
    $(`want-${command}`).checked = steps.some(([step]) => step === command);
  }
  form.fill(steps);
  form.show(chosenCommands());
}

async function prepare() {
  const [options, texts] = await Promise.all([table(), textPart('presets.json')]);
  presets = JSON.parse(texts);
  const usual = Object.values(presets).flatMap(({ steps }) => steps.flatMap(([, given]) => Object.keys(given)));
  for (const [command, words] of Object.entries(wanted)) {
    const label = document.createElement('label');
    const box = Object.assign(document.createElement('input'), { type: 'checkbox', id: `want-${command}` });
    box.addEventListener('change', () => form.show(chosenCommands()));
    label.title = options.commands.find(({ name }) => name === command).description;
    label.append(box, words);
    $('commands').append(label);
  }
  form = new Form(options, {
    main: $('options'),
    more: $('more'),
    commands: Object.keys(wanted),
    inFront: new Set([...usual, 'threshold', 'spacing']),
  });
  for (const name of Object.keys(presets)) {
    const label = document.createElement('label');
    const radio = Object.assign(document.createElement('input'), { type: 'radio', name: 'preset', value: name });
    radio.checked = name === 'Default';
    radio.addEventListener('change', () => choosePreset(name));
    label.append(radio, people[name] ?? name);
    $('presets').append(label);
  }
  choosePreset('Default');
  $('work').addEventListener('change', ({ target }) => {
    if (target.dataset.group === 'Input' && files.length > 0) look();
  });
}

// ---- the run ----
const chosenLabels = () => {
  const chosen = labels.filter(({ box }) => box.checked);
  return chosen.length === labels.length ? [] : [`--labels=${chosen.map(({ label }) => label).join(',')}`];
};

$('work').addEventListener('submit', async (event) => {
  event.preventDefault();
  if ($('run').disabled) return;
  calm();
  const commands = chosenCommands();
  if (commands.length === 0 || !labels.some(({ box }) => box.checked)) {
    fail(new Error(commands.length === 0 ? 'Choose what you want.' : 'Choose a label.'));
    return;
  }
  running = new AbortController();
  const { signal } = running;
  const done = new Map(commands.map((command) => [command, 0]));
  $('run').disabled = true;
  $('stop').hidden = $('progress').hidden = false;
  $('progress').value = 0;
  $('shown').hidden = true;
  say('Computing …');
  const start = performance.now();
  const base = baseOf(mainFile());
  const one = async (command) => {
    const isEdited = command === 'skeleton' && edits.all.length > 0;
    const result = await program(
      [
        command,
        ...outputs[command](base),
        ...(isEdited ? ['--edits', editsFile] : []),
        ...chosenLabels(),
        ...form.argumentsOf(command),
      ],
      ['--', mainFile()],
      {
        signal,
        onProgress(stage, fraction) {
          done.set(command, Math.max(done.get(command), fraction));
          $('progress').value = [...done.values()].reduce((sum, part) => sum + part, 0) / commands.length;
          $('stage').textContent = `${wanted[command]}: ${stage}`;
        },
      },
      isEdited ? [[editsFile, new TextEncoder().encode(edits.table)]] : [],
    );
    return [command, result];
  };
  try {
    const made = await inTurn(commands, one, signal);
    await show(made, base);
    say(`Done in ${number((performance.now() - start) / 1000)} s.`);
    $('certificate-title').focus({ preventScroll: true });
    $('shown').scrollIntoView({ block: 'start' });
  } catch (error) {
    if (signal.aborted) {
      say('Stopped; nothing was made.');
    } else {
      running.abort();
      fail(error);
    }
  } finally {
    $('run').disabled = labels.length === 0;
    $('stop').hidden = $('progress').hidden = true;
    $('stage').textContent = '';
  }
});
$('stop').addEventListener('click', () => running?.abort());
document.addEventListener('keydown', (event) => {
  if (event.key === 'Escape' && document.body.classList.contains('wide')) $('large').click();
});

/** As many at a time as there are processors. */
async function inTurn(commands, one, signal) {
  const left = [...commands];
  const made = [];
  const next = async () => {
    for (let command = left.shift(); command !== undefined && !signal.aborted; command = left.shift())
      made.push(await one(command));
  };
  await Promise.all(Array.from({ length: Math.min(left.length, navigator.hardwareConcurrency || 1) }, next));
  return made.sort(([a], [b]) => commands.indexOf(a) - commands.indexOf(b));
}

// ---- results ----
const textOf = (bytes) => new TextDecoder().decode(bytes);
const links = [];

function download(name, data, type = 'application/octet-stream') {
  const link = Object.assign(document.createElement('a'), {
    href: URL.createObjectURL(new Blob([data], { type })),
    download: name,
  });
  links.push(link.href);
  return link;
}

async function show(made, base) {
  for (const link of links.splice(0)) URL.revokeObjectURL(link);
  results = Object.assign({}, ...made.map(([, result]) => result.files));
  const words = [];
  const names = new Map(labels.map(({ label, name }) => [label, name]));
  for (const [command, result] of made) {
    const report = Object.entries(result.files).find(([name]) =>
      name.endsWith(command === 'roots' ? 'report.json' : `_${command}.json`),
    );
    for (const label of report ? (JSON.parse(textOf(report[1])).labels ?? []) : []) {
      const sentence = certificateWords(label);
      if (sentence) words.push({ words: `${wanted[command]}, ${sentence}`, passed: label.certificate.passed });
      names.set(label.label, label.name);
    }
  }
  const item = (line) => Object.assign(document.createElement('li'), { textContent: line });
  $('certificate').replaceChildren(...words.map((one) => item(one.words)));
  const good = words.filter(({ passed }) => passed).length;
  $('certificate-title').textContent = words.length === 0 ? 'Result' : `Result: ${good} of ${words.length} certified`;
  const warnings = [...new Set(made.flatMap(([, result]) => result.warnings))];
  $('warnings').replaceChildren(...warnings.map(item));
  $('warnings').hidden = warnings.length === 0;

  // Tables and histograms.
  $('tables').replaceChildren(
    ...Object.entries(results)
      .filter(([name]) => name.endsWith('.csv'))
      .map(([name, bytes]) => tableOf(name, textOf(bytes))),
  );
  const find = (ending) => Object.keys(results).find((name) => name.endsWith(ending));
  const thickness = find('_thickness.vtp');
  const surface = thickness ?? find('_core.vtp') ?? find('_sheets.vtp') ?? find('_roots/medial.vtp');
  const curves = find('_skeleton.vtp') ?? find('_roots/skeleton.vtp');
  const meshes = [];
  if (surface) meshes.push({ kind: 'medial', mesh: await readVtp(results[surface]) });
  if (curves) meshes.push({ kind: 'curves', mesh: await readVtp(results[curves]) });
  const figures = [];
  for (const { kind, mesh } of meshes) {
    for (const name of ['Radius', 'Thickness']) {
      const values = mesh.pointArrays[name];
      const range = values && rangeOf([values]);
      const title = `${name} of the ${kind === 'curves' ? 'curve skeleton' : 'medial surface'}`;
      const figure = range && histogramOf(title, values, range, unit);
      if (figure) figures.push(figure);
    }
  }
  $('histograms').replaceChildren(...figures);

  // Three dimensions: the offline page itself, in a frame.
  drawn = meshes.filter(({ mesh }) => mesh.points.length > 0);
  $('model').hidden = $('offline').hidden = drawn.length === 0;
  $('shown').hidden = false;
  slices.outline(drawn);
  if (drawn.length > 0) {
    const isEdited = curves?.endsWith('_skeleton.vtp'); // roots are edited by another table
    const about = { title: base, names, colors: labelColor, map: lengthColors, voxel: isEdited ? voxel : 0 };
    const page = pageOf(viewerTemplate, pageModel(drawn, about));
    viewer.srcdoc = page;
    $('offline').onclick = () => download(`${base}.html`, page, 'text/html').click();
  }
  $('downloads').replaceChildren(
    ...Object.entries(results)
      .sort()
      .map(([name, bytes]) => {
        const row = document.createElement('li');
        const link = download(name.replaceAll('/', '_'), bytes);
        link.textContent = name;
        row.append(link, ` ${number(bytes.length / 1000)} kB`);
        return row;
      }),
  );
}

$('zip').addEventListener('click', () => {
  download(`${baseOf(mainFile())}.zip`, zipSync(results, { level: 0 }), 'application/zip').click();
});
$('large').addEventListener('click', () => {
  const large = document.body.classList.toggle('wide');
  $('large').setAttribute('aria-pressed', large);
  $('large').textContent = large ? 'Back' : 'Large view';
});

$('licences').addEventListener('toggle', async () => {
  $('licences').querySelector('pre').textContent = await textPart('licences.txt').catch((error) => error.message);
});

// ---- start ----
async function start() {
  const [wasm, worker, template, map] = await Promise.all([
    part('voxelcore.wasm'),
    textPart('worker.js'),
    textPart('viewer.html'),
    textPart('colors.json'),
  ]);
  viewerTemplate = template;
  lengthColors = JSON.parse(map);
  const place = URL.createObjectURL(new Blob([worker], { type: 'text/javascript' }));
  configure({ wasm, worker: () => new Worker(place) }); // a classic one: a page from disk may start no other
  await prepare();
  document.body.dataset.state = 'ready';
  if (navigator.serviceWorker && document.querySelector('link[rel="manifest"]')) {
    await navigator.serviceWorker.register('sw.js');
  }
}
start().catch(fail);
