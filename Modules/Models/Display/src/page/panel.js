// The panel: colours, what is shown, the list of labels, the picture as a file.
/* global THREE, Page */
if (Page && Page.view) (function () {
  'use strict';
  const { $, model, view, names } = Page, { state } = view;

  // ---- colours ----
  for (const name of Object.keys(model.ranges).concat('Label', view.named.length ? 'Branch' : [])) {
    $('coloring').add(new Option(names[name], name));
  }
  if (model.byLabel) $('coloring').value = 'Label';
  else if (model.ranges.Confidence) $('coloring').value = 'Confidence';
  const takeColoring = () => {
    state.coloring = $('coloring').value;
    $('range').value = view.chosenRange();
  };
  takeColoring();
  $('coloring').addEventListener('change', () => {
    takeColoring();
    for (const element of document.querySelectorAll('.ranged')) element.hidden = !view.ranged();
    view.paint();
  });
  $('range').addEventListener('change', () => { state.range = $('range').value; view.paint(); });

  // ---- kinds ----
  for (const kind of ['surface', 'medial', 'curves']) {
    const box = $(kind), slider = $(kind + '-opacity');
    box.addEventListener('change', () => {
      state.shown[kind] = box.checked;
      slider.disabled = !box.checked;
      view.showParts();
    });
    slider.addEventListener('input', () => { state.opacity[kind] = slider.value / 100; view.showParts(); });
    state.opacity[kind] = slider.value / 100;
    if (!model.labels.some(label => label[kind])) {
      box.parentElement.hidden = slider.hidden = true;
      state.shown[kind] = false;
    }
  }
  if (!state.shown.medial && !state.shown.curves) { // nothing is in the surfaces
    $('surface-opacity').value = 100;
    state.opacity.surface = 1;
  }

  // ---- views ----
  const views = model.anatomical
    ? { front: ['Front', 'From the front: superior up', [0, -1, 0], [0, 0, 1]],
      left: ['Left', 'From the left: superior up', [1, 0, 0], [0, 0, 1]],
      top: ['Top', 'From above: anterior up', [0, 0, 1], [0, -1, 0]] }
    : model.groups
      ? { front: ['Front', 'From the front', [0, -1, 0], [0, 0, 1]],
        left: ['Side', 'From the side', [1, 0, 0], [0, 0, 1]],
        top: ['Top', 'From above', [0, 0, 1], [0, 1, 0]] }
      : { front: ['−y', 'Along the y axis: z up', [0, -1, 0], [0, 0, 1]],
        left: ['+x', 'Against the x axis: z up', [1, 0, 0], [0, 0, 1]],
        top: ['+z', 'Against the z axis: y up', [0, 0, 1], [0, 1, 0]] };
  for (const [id, [words, title, from, up]] of Object.entries(views)) {
    $(id).textContent = words;
    $(id).title = title;
    $(id).setAttribute('aria-label', title);
    $(id).addEventListener('click', () => view.lookFrom(from, up));
  }
  $('fit').addEventListener('click', view.fit);

  // ---- ground ----
  function setGround(dark) {
    state.dark = dark;
    document.documentElement.dataset.ground = dark ? 'dark' : 'light';
    $('ground').setAttribute('aria-pressed', dark);
    view.paint();
  }
  $('ground').addEventListener('click', () => setGround(!state.dark));

  // ---- files; the picture ----
  let silence = 0;
  function say(sentence) {
    $('said').textContent = sentence;
    $('said').hidden = false;
    clearTimeout(silence);
    silence = setTimeout(() => { $('said').hidden = true; }, 4000);
  }
  function save(blob, ending) {
    const link = document.createElement('a'), place = URL.createObjectURL(blob);
    link.href = place;
    link.download = model.title.replace(/[^\w.-]+/g, '_') + ending;
    link.click();
    setTimeout(() => URL.revokeObjectURL(place), 60000);
    say('Saved as ' + link.download + '.');
  }
  Object.assign(Page, { say, save, fold });
  $('save').addEventListener('click', () => {
    view.picture().toBlob(blob => {
      if (!blob) return say('The browser gave no picture; make the window smaller.');
      save(blob, '.png');
    }, 'image/png');
  });

  // ---- labels ----
  function choose(label) {
    state.chosen = state.chosen === label ? null : label;
    for (const one of model.labels) one.nameElement.setAttribute('aria-pressed', one === state.chosen);
    if (state.chosen && !label.visible) {
      label.visible = label.box.checked = true;
    }
    view.showParts();
    count();
  }
  const found = () => model.labels.filter(label => !label.row.hidden);
  function count() {
    const visible = model.labels.filter(label => label.visible).length, all = model.labels.length, listed = found().length;
    $('count').textContent = listed < all ? listed + ' of ' + all + ' found' : visible + ' of ' + all + ' shown';
  }
  const list = document.createDocumentFragment();
  for (const label of model.labels) {
    const row = document.createElement('li'), box = document.createElement('input'), name = document.createElement('button');
    const swatch = document.createElement('span'), number = document.createElement('span');
    label.visible = true;
    box.type = 'checkbox';
    box.checked = true;
    box.setAttribute('aria-label', 'Show ' + label.name);
    box.addEventListener('change', () => { label.visible = box.checked; view.showParts(); count(); });
    swatch.className = 'swatch';
    swatch.style.background = 'rgb(' + label.color.map(v => Math.round(255 * v)).join(',') + ')';
    name.type = 'button';
    name.className = 'name';
    name.textContent = label.name;
    name.title = label.name + ': single it out';
    name.setAttribute('aria-pressed', 'false');
    name.addEventListener('click', () => choose(label));
    number.className = 'number';
    number.textContent = model.groups ? '' : label.label;
    row.append(box, swatch, name, number);
    list.append(row);
    Object.assign(label, { row, box, nameElement: name });
  }
  $('labels').append(list);
  $('search').addEventListener('input', () => {
    const words = $('search').value.toLowerCase().split(/\s+/).filter(word => word);
    for (const label of model.labels) {
      const text = label.name.toLowerCase();
      label.row.hidden = !words.every(word => text.includes(word) || String(label.label) === word);
    }
    count();
  });
  for (const [id, state] of [['all', true], ['none', false]]) {
    $(id).addEventListener('click', () => {
      for (const label of found()) label.visible = label.box.checked = state;
      view.showParts();
      count();
    });
  }
  view.canvas.addEventListener('dblclick', event => {
    const hit = view.hitAt(event.clientX, event.clientY);
    if (!hit) return;
    choose(hit.object.userData.label);
    if (state.chosen) state.chosen.row.scrollIntoView({ block: 'nearest' });
  });
  if (model.labels.length < 2) $('find').hidden = true;
  if (model.groups) { // few, and not known by number
    $('search').hidden = true;
    $('range').options[2].text = 'each one\'s own';
  }

  // ---- folding ----
  function fold(folded) {
    document.body.classList.toggle('folded', folded);
    $('fold').setAttribute('aria-expanded', !folded);
    view.resize();
  }
  $('fold').addEventListener('click', () => fold(!document.body.classList.contains('folded')));

  const thousands = n => String(n).replace(/\B(?=(\d{3})+$)/g, ',');
  $('title').textContent = document.title = $('title').title = model.title;
  $('about').textContent = (model.triangles < model.allTriangles
    ? 'Shown in ' + thousands(model.triangles) + ' triangles of ' + thousands(model.allTriangles) + '; the files hold all of them. '
    : thousands(model.triangles) + ' triangles. ') + 'Drag or one finger: turn. Wheel or two fingers: zoom. Right button or Shift: ' +
    'move. Double click: single out a label. Parallel projection: the scale bar holds everywhere. Made by VoxelCore with ' +
    'three.js r' + THREE.REVISION + ' (MIT licence).';
  for (const element of document.querySelectorAll('.ranged')) element.hidden = !view.ranged();
  setGround(window.matchMedia('(prefers-color-scheme: dark)').matches);
  view.showParts();
  count();
  fold(window.matchMedia('(max-width: 640px)').matches);
  view.lookFrom([0.45, -1, 0.35], [0, 0, 1]);
  if (document.body.dataset.state !== 'failed') document.body.dataset.state = 'ready';
})();
