// Corrections of skeletons: a branch is clicked, an edit is chosen; all of them go into a table that `--edits` reads.
/* global THREE, Page */
if (Page && Page.view) Page.edits = (function () {
  'use strict';
  const { $, model, view, meshes, numbers, places, valuesOf, lengthText } = Page;
  const trees = model.labels.filter(label => label.curves && label.curves.lines[1] > 0);
  if (trees.length === 0 || !(model.voxel > 0)) return null; // roots are edited by another table

  // ---- trees ----
  // Branches as the program has them, by places: what was cut into two tips at one place is one node here.
  function treeOf(mesh) {
    const near = places(mesh, meshes.middle), codes = numbers(mesh.points), lines = numbers(mesh.lines), offsets = numbers(mesh.offsets);
    const nodeOf = point => codes.slice(3 * point, 3 * point + 3).join();
    const neighbours = new Map(), ends = [];
    const link = (from, to, branch) => {
      if (!neighbours.has(from)) neighbours.set(from, []);
      neighbours.get(from).push([to, branch]);
    };
    for (let branch = 0; branch + 1 < offsets.length; ++branch) {
      const [a, b] = [lines[offsets[branch]], lines[offsets[branch + 1] - 1]].map(nodeOf);
      ends.push([a, b]);
      link(a, b, branch);
      link(b, a, branch);
    }
    const corners = numbers(mesh.triangles); // of faces that stay
    for (let i = 0; i < corners.length; i += 3) {
      for (let k = 0; k < 3; ++k) {
        const [a, b] = [corners[i + k], corners[i + (k + 1) % 3]].map(nodeOf);
        link(a, b, -1);
        link(b, a, -1);
      }
    }
    return {
      near, lines, offsets, ends, radius: valuesOf(mesh, 'Radius'), count: ends.length,
      isTip: node => neighbours.get(node).length === 1,
      // whether its ends meet without it
      isOnLoop(branch) {
        const [from, to] = ends[branch], seen = new Set([from]), waiting = [from];
        while (waiting.length > 0) {
          for (const [next, by] of neighbours.get(waiting.pop())) {
            if (by === branch || seen.has(next)) continue;
            seen.add(next);
            waiting.push(next);
          }
        }
        return from === to || seen.has(to);
      }
    };
  }
  for (const label of trees) label.tree = treeOf(label.curves);

  const sizeOf = ({ label, branch }) => label.tree.offsets[branch + 1] - label.tree.offsets[branch];
  const pointOf = ({ label, branch, at }) => label.tree.lines[label.tree.offsets[branch] + at];
  const nearOf = spot => spot.near || [0, 1, 2].map(k => spot.label.tree.near[3 * pointOf(spot) + k]);
  const placeOf = spot => nearOf(spot).map((v, k) => v + meshes.middle[k]);
  function lengthOf({ label, branch }) {
    const { near, lines, offsets } = label.tree;
    let length = 0;
    for (let i = offsets[branch] + 1; i < offsets[branch + 1]; ++i) {
      length += Math.hypot(...[0, 1, 2].map(k => near[3 * lines[i] + k] - near[3 * lines[i - 1] + k]));
    }
    return length;
  }
  // The free tip of a spot's branch, the nearer one of two; null where it has none.
  function tipOf(spot) {
    const { label, branch, at } = spot, last = sizeOf(spot) - 1, [first, second] = label.tree.ends[branch].map(label.tree.isTip);
    if (!first && !second) return null;
    return { label, branch, at: first && (!second || 2 * at <= last) ? 0 : last };
  }
  const wordsOf = ({ label, branch }) => (branch === undefined ? 'the voxel' : 'branch ' + numberOf(label, branch)) +
    (trees.length > 1 ? ' of ' + label.name : '');
  // The web's pages know each branch's number in its file; else they are in the file's order.
  const numberOf = (label, branch) => label.curves.numbers ? label.curves.numbers[branch] : branch;

  // ---- the table ----
  // As the program writes fields: what a spreadsheet would take for a formula becomes text.
  function field(text) {
    const guarded = (/^[=+\-@]/.test(text) ? '\'' : '') + text; // no control character comes here
    return /[,"]/.test(guarded) ? '"' + guarded.replace(/"/g, '""') + '"' : guarded;
  }
  const digits = value => String(+value.toPrecision(7));
  const placeText = (place, between) => place.map(digits).join(between);
  const changes = [];
  const made = []; // { kind, label, place, further, name, words }, as plain data
  function table() {
    const wide = trees.length > 1;
    return (wide ? 'label,' : '') + 'branch,junction,x,y,z,edit,name\n' + made.map(({ kind, label, place, further, name }) => {
      const edit = kind === 'name' ? '' : kind + further.map((one, i) => (i > 0 ? '; ' : ' ') + placeText(one, ' ')).join('');
      return (wide ? label + ',' : '') + ',,' + placeText(place, ',') + ',' + edit + ',' + field(name) + '\n';
    }).join('');
  }

  // ---- what is marked ----
  const colors = { chosen: [230, 0, 126], made: [217, 95, 2] };
  const marks = [['Points', 'DOT'], ['LineSegments', 'LINE']].map(([kind, define]) => {
    const object = new THREE[kind](meshes.shape(new Float32Array(0)), meshes.material({ [define]: 1 }));
    object.frustumCulled = object.material.depthTest = false;
    object.material.transparent = true;
    object.renderOrder = 9;
    object.material.uniforms.pixels.value = 13 * window.devicePixelRatio;
    view.scene.add(object);
    return object;
  });
  function draw(object, points) {
    const geometry = meshes.shape(Float32Array.from([].concat(...points.map(([near]) => near))));
    geometry.attributes.color.array.set([].concat(...points.map(([, color]) => color)));
    object.geometry.dispose();
    object.geometry = geometry;
  }

  // ---- state ----
  let chosen = null, asked = null, isSaved = true; // a spot: { label, branch, at } or { label, near }; what waits for more places
  const isOpen = () => !$('edits').hidden;
  const nearTo = place => place.map((v, k) => v - meshes.middle[k]);

  function show() {
    const dots = [], segments = [];
    const line = (near, color) => near.forEach((one, i) => { if (i > 0) segments.push([near[i - 1], color], [one, color]); });
    for (const { place, further } of made) {
      const all = [place, ...further].map(nearTo);
      dots.push(...all.map(near => [near, colors.made]));
      line(all, colors.made);
    }
    if (asked) {
      const all = [asked.from, ...asked.further].map(nearOf);
      dots.push(...all.map(near => [near, colors.chosen]));
      line(all, colors.chosen);
    }
    if (chosen) dots.push([nearOf(chosen), colors.chosen]);
    draw(marks[0], isOpen() ? dots : []);
    draw(marks[1], isOpen() ? segments : []);
    const branch = isOpen() && chosen && chosen.branch !== undefined ? chosen : null;
    const before = view.state.marked, isSame = branch && before && before.label === branch.label && before.line === branch.branch;
    view.state.marked = branch && { label: branch.label, line: branch.branch, color: colors.chosen };
    if (isSame || (!branch && !before)) view.draw();
    else view.paint();

    $('edit-row').textContent = !chosen ? 'Click a branch, or choose it by its number.'
      : branch ? wordsOf(branch).replace(/^b/, 'B') + ': length ' + lengthText(lengthOf(branch), 3) + ', radius here ' +
        (branch.label.tree.radius ? lengthText(branch.label.tree.radius[pointOf(branch)], 3) : 'unknown') +
        (trees.length > 1 ? '' : ', ' + branch.label.name)
        : 'A voxel at ' + view.placeText(placeOf(chosen));
    if (branch) {
      $('edit-label').value = trees.indexOf(branch.label);
      $('edit-branch').value = numberOf(branch.label, branch.branch);
      $('edit-place').max = sizeOf(branch) - 1;
      $('edit-place').value = branch.at;
      $('edit-place').setAttribute('aria-valuetext', view.placeText(placeOf(branch)));
    }
    $('edit-place').disabled = !branch;
    const tip = branch && tipOf(branch);
    // Deep within a body a voxel that is taken out would be a cavity.
    const thin = branch && branch.label.tree.radius && branch.label.tree.radius[pointOf(branch)] <= 1.5 * model.voxel;
    const makesSense = { cut: branch, remove: branch, root: tip, loop: branch && branch.label.tree.isOnLoop(branch.branch),
      background: chosen && (!branch || thin), join: tip, path: branch };
    for (const button of $('edit-choices').children) button.hidden = !!asked || !makesSense[button.value];
    $('edit-naming').hidden = !!asked || !branch;
    $('edit-asks').hidden = $('edit-steps').hidden = !asked;
    if (asked) {
      $('edit-asks').textContent = asked.kind === 'join'
        ? 'Click the other tip, or choose its branch above.'
        : asked.further.length + (asked.further.length === 1 ? ' place' : ' places') + ' so far. Click the places that the path runs through, in their order.';
      $('edit-finish').hidden = asked.kind === 'join';
      $('edit-finish').disabled = asked.further.length === 0;
    }
    $('edit-save').disabled = made.length === 0;
  }

  function choose(spot) {
    chosen = spot;
    if (spot && spot.branch !== undefined) $('edit-name').value = '';
    show();
  }
  function open(isWanted) {
    $('edits').hidden = !isWanted;
    $('correct').setAttribute('aria-expanded', isWanted);
    if (!isWanted) asked = null;
    const isNarrow = window.matchMedia('(max-width: 640px)').matches; // as in page.css
    if (isWanted && isNarrow) Page.fold(true);
    view.state.covered = { left: isWanted && !isNarrow ? 330 : 0, bottom: isWanted && isNarrow ? view.state.height / 2 : 0 };
    if (!view.state.moved) view.fit();
    show();
  }

  // ---- edits ----
  // Of roots there is one a label, and of names one a place; the same edit twice is one.
  function add(kind, spot, further, name, words) {
    const one = { kind, label: spot.label.label, place: placeOf(spot), further: further.map(placeOf), name, words };
    const isSame = other => kind === 'root' ? other.kind === kind && other.label === one.label
      : other.kind === kind && placeText(other.place) === placeText(one.place) && (kind === 'name' ||
        placeText([].concat(...other.further)) === placeText([].concat(...one.further)));
    const old = made.findIndex(isSame);
    if (old >= 0) made.splice(old, 1);
    made.push(one);
    asked = null;
    change();
    Page.say(words + '.');
  }
  function list() {
    $('edit-list').textContent = '';
    made.forEach((one, i) => {
      const row = document.createElement('li'), undo = document.createElement('button');
      undo.type = 'button';
      undo.textContent = 'Undo';
      undo.setAttribute('aria-label', 'Undo: ' + one.words);
      undo.addEventListener('click', () => {
        made.splice(i, 1);
        change();
        const rest = $('edit-list').querySelectorAll('button');
        (rest[Math.min(i, rest.length - 1)] || $('edit-branch')).focus();
      });
      row.append(one.words, undo);
      $('edit-list').append(row);
    });
    show();
  }
  function change() {
    isSaved = false;
    list();
    for (const call of changes) call(made);
  }
  const single = {
    cut: spot => add('cut', spot, [], '', 'Cut ' + wordsOf(spot) + ' at ' + view.placeText(placeOf(spot))),
    remove: spot => add('remove', spot, [], '', 'Remove ' + wordsOf(spot)),
    root: spot => add('root', tipOf(spot), [], '', 'Root at the tip of ' + wordsOf(spot)),
    loop: spot => add('loop', spot, [], '', 'The loop through ' + wordsOf(spot) + ' is real'),
    background: spot => add('background', spot, [], '', 'The voxel at ' + view.placeText(placeOf(spot)) + ' is background')
  };
  for (const button of $('edit-choices').children) {
    button.addEventListener('click', () => {
      if (single[button.value]) return single[button.value](chosen);
      asked = { kind: button.value, from: button.value === 'join' ? tipOf(chosen) : chosen, further: [] };
      show();
      $('edit-step').focus();
    });
  }
  $('edit-naming').addEventListener('submit', event => {
    event.preventDefault();
    const name = $('edit-name').value.replace(/[\u0000-\u001f]/g, ' ').trim(); // eslint-disable-line no-control-regex
    if (!name) return Page.say('Type a name first.');
    if (new TextEncoder().encode(name).length > 200) return Page.say('The name is too long.');
    add('name', chosen, [], name, 'Name ' + wordsOf(chosen) + ' “' + name + '”');
  });
  // Another place of an edit that takes more than one.
  function step(spot) {
    if (asked.kind === 'path') {
      if (spot.label !== asked.from.label) return Page.say('A path runs within one label.');
      asked.further.push(spot);
      chosen = spot;
      return show();
    }
    const tip = spot.branch !== undefined && tipOf(spot);
    if (!tip) return Page.say('No tip is there; choose a branch that ends free.');
    if (tip.label !== asked.from.label) return Page.say('Only tips of one label can be joined.');
    if (pointOf(tip) === pointOf(asked.from)) return Page.say('That is the same tip.');
    const { from } = asked;
    chosen = tip;
    add('join', from, [tip], '', 'Join the tips of ' + wordsOf(from) + ' and ' + wordsOf(tip));
  }
  $('edit-step').addEventListener('click', () => { if (chosen) step(chosen); });
  $('edit-finish').addEventListener('click', () => {
    const { from, further } = asked;
    add('path', from, further, '', 'Path from ' + wordsOf(from) + ' through ' + further.length + (further.length === 1 ? ' place' : ' places'));
  });
  $('edit-cancel').addEventListener('click', () => { asked = null; show(); });
  $('edit-save').addEventListener('click', () => {
    Page.save(new Blob([table()], { type: 'text/csv' }), '_edits.csv');
    isSaved = true;
  });

  // ---- choosing ----
  // The branch that is hit, or the nearest within so many pixels.
  function branchAt(x, y, reach) {
    const hit = view.hitAt(x, y, part => part.userData.entryAt);
    if (hit) {
      const { label, lineAt, entryAt } = hit.object.userData, corner = view.cornerOf(hit), branch = lineAt[corner];
      return { label, branch, at: entryAt[corner] - label.tree.offsets[branch] };
    }
    const [x0, y0] = view.fromMiddle(x, y);
    let found = null, nearest = reach;
    for (const label of trees) {
      if (!label.visible || !view.state.shown.curves || (view.state.chosen && view.state.chosen !== label)) continue;
      const { near, lines, offsets, count } = label.tree;
      for (let branch = 0; branch < count; ++branch) {
        for (let i = offsets[branch]; i < offsets[branch + 1]; ++i) {
          const [right, down] = view.pixelsOf(near, 3 * lines[i]), away = Math.hypot(right - x0, down - y0);
          if (away >= nearest) continue;
          nearest = away;
          found = { label, branch, at: i - offsets[branch] };
        }
      }
    }
    return found;
  }
  // A place on what is drawn: of a surface half a voxel below it, which is within the body.
  function spotAt(x, y) {
    const hit = view.hitAt(x, y);
    if (!hit || !hit.object.userData.label.tree) return null;
    const { label, kind } = hit.object.userData, near = hit.point.clone();
    if (kind === 'surface' && hit.face) {
      const inwards = hit.face.normal.clone().multiplyScalar(hit.face.normal.dot(view.sight()) < 0 ? -1 : 1);
      near.addScaledVector(inwards, model.voxel / 2);
    }
    return { label, near: near.toArray() };
  }
  view.taps.push((x, y, isTouch) => {
    const branch = branchAt(x, y, isTouch ? 24 : 10), spot = branch || (isOpen() ? spotAt(x, y) : null);
    if (!spot) return;
    if (asked) return step(spot);
    choose(spot);
    if (!isOpen()) open(true);
  });
  trees.forEach((label, i) => $('edit-label').add(new Option(label.name, i)));
  if (trees.length > 1) $('edit-how').querySelector('code').textContent = 'voxelcore skeleton SCAN --labels N --edits FILE -o OUT.vtp';
  for (const element of document.querySelectorAll('.edit-label')) element.hidden = trees.length < 2;
  const middleOf = (label, branch) => ({ label, branch, at: sizeOf({ label, branch }) >> 1 });
  $('edit-label').addEventListener('change', () => choose(middleOf(trees[$('edit-label').value], 0)));
  $('edit-branch').addEventListener('input', () => {
    const label = trees[$('edit-label').value], wanted = Number($('edit-branch').value);
    const branch = $('edit-branch').value === '' ? -1 : label.curves.numbers ? label.curves.numbers.indexOf(wanted) : wanted;
    if (Number.isInteger(branch) && branch >= 0 && branch < label.tree.count) choose(middleOf(label, branch));
  });
  $('edit-place').addEventListener('input', () => choose(Object.assign({}, chosen, { at: Number($('edit-place').value) })));
  $('correct').hidden = false;
  $('correct').addEventListener('click', () => {
    open(!isOpen());
    if (isOpen()) $('edit-branch').focus();
  });
  $('edits-close').addEventListener('click', () => { open(false); view.canvas.focus(); });
  document.addEventListener('keydown', event => {
    if (event.key !== 'Escape' || !isOpen()) return;
    if (asked) {
      asked = null;
      show();
    } else {
      open(false);
      view.canvas.focus();
    }
  });
  window.addEventListener('beforeunload', event => {
    if (!isSaved && made.length > 0 && window.parent === window) event.preventDefault();
  });
  show();

  // For a page around this one: `changes` are told of all edits when there is one more or less.
  return {
    changes, table,
    take(edits) { made.splice(0, made.length, ...edits); list(); },
    // A place chosen elsewhere, in the label that was chosen last.
    spot(place) {
      if (isOpen()) choose({ label: chosen ? chosen.label : trees[0], near: nearTo(place) });
    }
  };
})();
