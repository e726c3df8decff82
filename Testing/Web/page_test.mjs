// The page of Applications/web in headless Chromium, against the native program.
// usage: node page_test.mjs PROGRAM PACKAGE FOLDER PART    PACKAGE: of Applications/web/build.sh; FOLDER: to work in
// PART: results, slices, wrong, labels, folders, cancel, edits, offline, file or phone. Exit code 77: no Chromium, npm or
// package.

import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import zlib from 'node:zlib';

const here = path.dirname(fileURLToPath(import.meta.url));
const root = path.join(here, '../..');
const data = path.join(root, 'Data');
const [program, packageFolder, folder, part] = process.argv.slice(2);
const browserPath = ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium'].find((name) => fs.existsSync(name));

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
function check(holds, what) {
  if (!holds) throw new Error(what);
}
const equal = (found, expected, what) => check(found === expected, `${what}: ${found}, not ${expected}`);

if (!browserPath) skip('there is no Chromium');
if (!fs.existsSync(path.join(packageFolder, 'voxelcore.wasm')))
  skip(`${packageFolder} is not there; make it with Applications/web/build.sh`);
if (spawnSync('npm', ['--version']).status !== 0) skip('there is no npm');

// The page is made once for all parts, which may run side by side.
fs.mkdirSync(folder, { recursive: true });
execFileSync(
  'flock',
  [
    path.join(folder, 'lock'),
    'sh',
    '-c',
    'test "$3/page/sw.js" -nt "$2/voxelcore.wasm" && ' +
      'test -z "$(find "$4" -newer "$3/page/sw.js" -type f)" || node "$1" "$2" "$3"',
    'sh',
    path.join(root, 'Applications/web/page/build.mjs'),
    packageFolder,
    folder,
    path.join(root, 'Applications/web/page'),
  ],
  { stdio: 'inherit' },
);
const { chromium } = await import(pathToFileURL(path.join(folder, 'tools/node_modules/playwright-core/index.mjs')));
const { unzipSync } = await import(pathToFileURL(path.join(folder, 'tools/node_modules/fflate/esm/index.mjs')));

const types = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.png': 'image/png',
  '.webmanifest': 'application/manifest+json',
};
const server = http.createServer((request, answer) => {
  const name = path.join(folder, 'page', path.normalize(new URL(request.url, 'http://localhost').pathname));
  const file = name.endsWith('/') ? `${name}index.html` : name;
  if (!fs.existsSync(file)) {
    answer.writeHead(404).end();
    return;
  }
  answer
    .writeHead(200, { 'content-type': types[path.extname(file)] ?? 'application/octet-stream' })
    .end(fs.readFileSync(file));
});
await new Promise((resolve) => {
  server.listen(0, '127.0.0.1', resolve);
});
const origin = `http://127.0.0.1:${server.address().port}/`;

const browser = await chromium.launch({
  executablePath: browserPath,
  args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});

/** A page that is ready; all it asks for is its own, and nothing in it fails unheard. */
async function open(address = origin, { width = 1440, scheme = 'light' } = {}) {
  const context = await browser.newContext({
    viewport: { width, height: 900 },
    colorScheme: scheme,
    acceptDownloads: true,
  });
  const page = await context.newPage();
  page.foreign = [];
  page.failures = [];
  context.on('request', (request) => {
    const url = request.url();
    const own = address.startsWith('file:') ? url === address : url.startsWith(address);
    if (!own && !/^(blob|data|about):/.test(url)) page.foreign.push(url);
  });
  page.on('pageerror', (error) => page.failures.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') page.failures.push(message.text());
  });
  page.setDefaultTimeout(120000);
  await page.goto(address);
  await page.waitForSelector('body[data-state=ready]');
  return page;
}
async function close(page) {
  check(page.foreign.length === 0, `asked a network for ${page.foreign.join(' ')}`);
  check(page.failures.length === 0, `failed: ${page.failures.join('\n')}`);
  await page.context().close();
}

async function give(page, ...names) {
  await page.setInputFiles('#files', names);
  await page.waitForFunction(() => !document.getElementById('what').textContent.startsWith('Reading'));
}
async function drop(page, name) {
  const bytes = fs.readFileSync(name).toString('base64');
  await page.evaluate(
    ([file, text]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], file));
      document.getElementById('drop').dispatchEvent(new DragEvent('drop', { bubbles: true, dataTransfer: transfer }));
    },
    [path.basename(name), bytes],
  );
  await page.waitForSelector('#run:enabled');
}
async function want(page, ...commands) {
  for (const command of ['core', 'skeleton', 'thickness', 'sheets', 'roots']) {
    await page.setChecked(`#want-${command}`, commands.includes(command));
  }
}
async function compute(page) {
  await page.click('#run');
  await page.waitForSelector('#shown:not([hidden]), #failure:not([hidden])', { state: 'attached' });
  check(await page.isHidden('#failure'), `failed: ${await page.textContent('#failure')}`);
  check(await page.isHidden('#stop'), 'it still runs');
}
/** The viewer's frame, when its picture stands. */
async function viewer(page) {
  await page.frameLocator('#viewer').locator('body[data-state=ready]').waitFor({ state: 'attached' });
  return page.frames().find((frame) => frame !== page.mainFrame());
}
async function filesOf(page) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#zip')]);
  return unzipSync(fs.readFileSync(await download.path()));
}
const shot = (page, name) => page.screenshot({ path: path.join(folder, `${name}.png`), fullPage: true });

/** What a report says but for time, memory, threads and the words of the command line. */
function lasting(bytes) {
  const report = JSON.parse(Buffer.from(bytes).toString());
  delete report.voxelcore.command;
  delete report.seconds;
  delete report.peak_memory_mb;
  delete report.parameters?.threads;
  return JSON.stringify(report);
}

const parts = {
  async results() {
    const page = await open();
    const runs = [
      ['root.nrrd', 'core'],
      ['capsule.mha', 'core', 'skeleton'],
      ['torus.nrrd', 'thickness'],
      ['plate-3.nrrd', 'sheets'],
      ['root.nrrd', 'roots'],
      ['ball-40.nii.gz', 'core'],
    ];
    const usual =
      'voxelcore core -o root_core.vtp --report root_core.json --table root_core.csv ' +
      '--tolerance=1.2diag --connectivity=joined -- root.nrrd';
    let compared = 0;
    for (const [scan, ...commands] of runs) {
      await drop(page, path.join(data, scan));
      await want(page, ...commands);
      await compute(page);
      check((await page.textContent('#certificate')).includes('certified'), `${scan}: no certificate`);
      const made = await filesOf(page);
      const links = await page.locator('#downloads a').allTextContents();
      equal([...links].sort().join(' '), Object.keys(made).sort().join(' '), `${scan}: links and files of the zip`);
      const [one] = await Promise.all([page.waitForEvent('download'), page.locator('#downloads a').first().click()]);
      check(
        Buffer.compare(fs.readFileSync(await one.path()), Buffer.from(made[links[0]])) === 0,
        `${links[0]}: not that of the zip`,
      );

      // The same words for the native program.
      const own = fs.mkdtempSync(path.join(folder, 'native-'));
      fs.copyFileSync(path.join(data, scan), path.join(own, scan));
      for (const [name, bytes] of Object.entries(made).filter(([file]) => file.endsWith('.json'))) {
        const { voxelcore } = JSON.parse(Buffer.from(bytes).toString());
        if (!voxelcore?.command) continue;
        const command = voxelcore.command.split(' ').filter((word) => !word.startsWith('--progress'));
        if (name === 'root_core.json') equal(command.join(' '), usual, 'the words of the default preset');
        execFileSync(program, command.slice(1), { cwd: own, stdio: 'pipe' });
        check(fs.existsSync(path.join(own, name)), `${name}: not among the native program's files`);
      }
      for (const [name, bytes] of Object.entries(made)) {
        const native = fs.readFileSync(path.join(own, name));
        const words = (text) => text.toString().replace(/<last-modified>.*<\/last-modified>/, '');
        const same =
          name.endsWith('.json') && JSON.parse(native.toString()).voxelcore?.command
            ? lasting(native) === lasting(bytes)
            : name.endsWith('.rsml')
              ? words(native) === words(Buffer.from(bytes))
              : Buffer.compare(native, Buffer.from(bytes)) === 0;
        check(same, `${scan}, ${commands}: ${name} differs from the native program's`);
        ++compared;
      }
      fs.rmSync(own, { recursive: true });
    }
    console.log(`${runs.length} runs, ${compared} files as of the native program`);

    // Preset, picture, slider, colours, offline page.
    await drop(page, path.join(data, 'gyroid.nrrd'));
    await page.check('input[name=preset][value=Bone]');
    check(
      (await page.isChecked('#want-thickness')) && !(await page.isChecked('#want-skeleton')),
      'the preset chose something else',
    );
    await compute(page);
    const frame = await viewer(page);
    const count = () => frame.evaluate(() => Page.view.parts.reduce((sum, one) => sum + one.geometry.index.count, 0));
    const all = await count();
    await frame.locator('#least-tolerance').fill('900');
    const few = await count();
    check(few < all && few > 0, `the slider left ${few} of ${all} corners`);
    await frame.locator('#least-tolerance').fill('0');
    equal(await count(), all, 'corners after the slider came back');
    const colorings = await frame.locator('#coloring option').allTextContents();
    for (const name of ['Radius', 'Lambda', 'Thickness', 'Tolerance'])
      check(colorings.includes(name), `no colours by ${name}: ${colorings}`);
    check((await page.locator('#histograms svg').count()) === 2, 'not two histograms');
    check((await page.locator('#tables table').count()) > 0, 'no table');
    await shot(page, 'result-1440');
    const [saved] = await Promise.all([page.waitForEvent('download'), page.click('#offline')]);
    const alone = await page.context().newPage();
    const copy = path.join(folder, 'offline-page.html');
    await saved.saveAs(copy);
    await alone.goto(pathToFileURL(copy).href);
    await alone.waitForSelector('body[data-state=ready]');
    await alone.close();
    page.foreign = page.foreign.filter((url) => url !== pathToFileURL(copy).href);
    await close(page);
  },

  async slices() {
    // What a plane cuts of a polygon: two points in it, on the polygon's sides.
    const { axesOfSpace, cut, freeLines } = await import(pathToFileURL(path.join(root, 'Applications/web/page/slices.js')));
    const seed = Number(process.env.VOXELCORE_SEED ?? Date.now() % 1000000);
    console.log(`seed ${seed}`);
    let state = seed;
    const random = () => {
      state = (state * 1103515245 + 12345) % 2147483648;
      return state / 2147483648;
    };
    for (let round = 0; round < 200; ++round) {
      const points = Float32Array.from({ length: 12 }, () => 10 * random());
      const mesh = {
        polys: { offsets: [0, 3, 6], connectivity: [0, 1, 2, 1, 2, 3] },
        lines: { offsets: [0, 2], connectivity: [0, 3] },
      };
      const [axis, at] = [round % 3, 10 * random()];
      const above = (i) => points[3 * i + axis] >= at;
      const expected = [
        [0, 1, 2],
        [1, 2, 3],
      ].filter((face) => new Set(face.map(above)).size === 2).length;
      const none = { offsets: [0], connectivity: [] };
      const found = cut(points, { ...mesh, lines: none }, axis, at);
      equal(found.length, expected, 'segments in a plane');
      for (const end of found.flat()) check(Math.abs(end[axis] - at) < 1e-4, `an end lies ${end[axis] - at} off its plane`);
      const near = [0, 3].some((i) => Math.abs(points[3 * i + axis] - at) <= 0.75) || above(0) !== above(3);
      equal(cut(points, { ...mesh, polys: none }, axis, at).length, near ? 1 : 0, 'lines beside a plane');
    }
    const free = freeLines({
      polys: { offsets: [0, 3], connectivity: [4, 2, 7] },
      lines: { offsets: [0, 4], connectivity: [2, 4, 5, 7] },
    });
    equal(JSON.stringify(free), '{"offsets":[0,2,4],"connectivity":[4,5,5,7]}', 'lines on no face');
    const turned = axesOfSpace([
      [0, 0.1, -2],
      [0.9, 0, 0],
      [0.1, 0.5, 0],
    ]);
    equal(JSON.stringify(turned.map(({ axis, sign }) => axis * sign)), '[1,2,0]', 'axes of the space');

    // A bar of two labels in a scan that runs against x and has z first: left of the patient is label 2.
    const own = fs.mkdtempSync(path.join(folder, 'slices-'));
    const name = path.join(own, 'bar.nrrd');
    const [nz, nx, ny] = [24, 40, 20];
    const voxels = Buffer.alloc(nz * nx * ny);
    for (let j = 6; j < 14; ++j)
      for (let i = 4; i < 36; ++i) voxels.fill(i < 20 ? 2 : 1, 8 + nz * (i + nx * j), 16 + nz * (i + nx * j));
    const head =
      'NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 24 40 20\n' +
      'space directions: (0,0,2) (-1,0,0) (0,1,0)\nspace origin: (39,0,0)\nencoding: raw\n\n';
    fs.writeFileSync(name, Buffer.concat([Buffer.from(head), voxels]));
    const page = await open();
    await give(page, name);
    const slider = (axis) => page.locator(`#across-${axis}`);
    await slider('z').waitFor();
    equal(await slider('z').getAttribute('max'), '23', 'slices across z');
    equal(await slider('x').getAttribute('max'), '39', 'slices across x');
    const drawn = () => page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); }));
    /** Colour of a place of a canvas, in parts of its sides: red, green, blue. */
    const color = async (plane, u, v) => {
      await drawn();
      return page.evaluate(
        ([index, x, y]) => {
          const canvas = document.querySelectorAll('#planes canvas')[index];
          const [px, py] = [Math.round(x * canvas.width), Math.round(y * canvas.height)];
          return [...canvas.getContext('2d').getImageData(px, py, 1, 1).data.slice(0, 3)].join(' ');
        },
        [plane, u, v],
      );
    };
    const [left, right] = [await color(0, 0.35, 0.45), await color(0, 0.65, 0.45)];
    check(left !== right && left !== '0 0 0' && right !== '0 0 0', `across z: ${left} and ${right}`);
    equal(await color(1, 0.35, 0.45), left, 'the same label across y');
    equal(await color(0, 0.02, 0.2), '0 0 0', 'beside the bar');
    await slider('z').fill('2'); // below the bar
    equal(await color(0, 0.35, 0.45), '0 0 0', 'a slice below the bar');
    check((await page.textContent('#place')).includes('background'), await page.textContent('#place'));
    const box = await page.locator('#planes canvas').nth(1).boundingBox();
    await page.mouse.click(box.x + 0.35 * box.width, box.y + 0.5 * box.height);
    check((await page.textContent('#place')).includes('label-1'), await page.textContent('#place'));
    await page.mouse.click(box.x + 0.65 * box.width, box.y + 0.5 * box.height);
    check((await page.textContent('#place')).includes('label-2'), await page.textContent('#place'));
    await page.keyboard.press('ArrowRight');
    await want(page, 'core', 'skeleton');
    await compute(page);
    const frame = await viewer(page);
    await page.waitForFunction(() => document.getElementById('place').textContent.includes('White'));
    const white = () =>
      page.evaluate(() =>
        [...document.querySelectorAll('#planes canvas')].map((canvas) => {
          const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
          let count = 0;
          for (let i = 0; i < data.length; i += 4) if (data[i] > 240 && data[i + 1] > 240 && data[i + 2] > 240) ++count;
          return count;
        }),
      );
    await drawn();
    check((await white()).every((count) => count > 20), `nothing of the medial surface in a slice: ${await white()}`);

    // A tap in three dimensions moves the slices.
    const before = await page.textContent('#place');
    const view = await frame.locator('#view').boundingBox();
    const hit = await frame.evaluate(() => {
      const around = Page.view.canvas.getBoundingClientRect();
      for (let part = 0.02; part < 1; part += 0.02) {
        const [x, y] = [around.left + part * around.width, around.top + (0.5 + 0.1 * Math.sin(60 * part)) * around.height];
        if (Page.view.hitAt(x, y)) return [x - around.left, y - around.top];
      }
      return null;
    });
    check(hit, 'nothing is hit in the viewer');
    await page.mouse.click(view.x + hit[0], view.y + hit[1]);
    await page.waitForFunction((words) => document.getElementById('place').textContent !== words, before);
    await page.locator('#slices').scrollIntoViewIfNeeded();
    await shot(page, 'slices-1440');
    await page.setViewportSize({ width: 390, height: 800 });
    await drawn();
    await shot(page, 'slices-390');
    check((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390, 'slices are too wide for a phone');

    fs.rmSync(own, { recursive: true });
    await close(page);
  },

  async wrong() {
    const page = await open();
    const own = fs.mkdtempSync(path.join(folder, 'wrong-'));
    const root3 = fs.readFileSync(path.join(data, 'root.nrrd'));
    const ball = fs.readFileSync(path.join(data, 'ball-40.nii.gz'));
    const nifti = zlib.gunzipSync(ball);
    const shell = fs.readFileSync(path.join(data, 'shell.mha'));
    const tiff = fs.readFileSync(path.join(data, 'tanglecube.tif'));
    const changed = (bytes, at, ...to) => {
      const copy = Buffer.from(bytes);
      copy.set(to, at);
      return copy;
    };
    const text = (bytes, from, to) => Buffer.from(bytes.toString('latin1').replace(from, to), 'latin1');
    const wrong = {
      'empty.nrrd': Buffer.alloc(0),
      'words.nrrd': Buffer.from('no scan\n'),
      'half.nrrd': root3.subarray(0, root3.length / 2),
      'head.nrrd': root3.subarray(0, 60),
      'sizes.nrrd': text(root3, /sizes: .*/, 'sizes: 9000000000 9000000000 9000000000'),
      'negative.nrrd': text(root3, /sizes: .*/, 'sizes: -1 2 3'),
      'type.nrrd': text(root3, /type: .*/, 'type: nonsense'),
      'empty.nii': Buffer.alloc(0),
      'half.nii': nifti.subarray(0, nifti.length / 2),
      'magic.nii': changed(nifti, 344, 0, 0, 0, 0),
      'rank.nii': changed(nifti, 40, 99),
      'half.nii.gz': ball.subarray(0, ball.length / 2),
      'noise.nii.gz': changed(ball, 40, 1, 2, 3, 4, 5, 6, 7, 8),
      'half.mha': shell.subarray(0, shell.length - 10),
      'words.mha': Buffer.from('ObjectType = Image\n'),
      'half.tif': tiff.subarray(0, tiff.length / 2),
      'words.tif': Buffer.from('II*'),
      'zeros.nrrd': Buffer.alloc(1000),
      'words.npy': Buffer.from('NUMPY'),
      'unknown.xyz': Buffer.from('what is it'),
      'words.mgz': Buffer.from('no scan'),
    };
    let slowest = 0;
    for (const [name, bytes] of Object.entries(wrong)) {
      fs.writeFileSync(path.join(own, name), bytes);
      const native = spawnSync(program, ['info', '--json', '--', name], { cwd: own, encoding: 'utf8' });
      check(native.status !== 0, `${name}: the native program reads it`);
      const start = Date.now();
      await give(page, path.join(own, name));
      slowest = Math.max(slowest, Date.now() - start);
      equal(await page.textContent('#failure'), native.stderr.trimEnd().replaceAll(/^voxelcore: /gm, ''), name);
      check(await page.isDisabled('#run'), `${name}: it can be run`);
    }
    check(slowest < 10000, `a wrong file took ${slowest} ms`);
    await drop(page, path.join(data, 'torus.nrrd')); // and it goes on
    check(await page.isHidden('#failure'), 'the line of the wrong file still stands');
    console.log(`${Object.keys(wrong).length} wrong files, the slowest said after ${slowest} ms`);
    fs.rmSync(own, { recursive: true });
    await close(page);
  },

  async labels() {
    const count = 300;
    const [nx, ny, nz] = [5 * 20, 5 * 15, 5];
    const voxels = Buffer.alloc(2 * nx * ny * nz);
    for (let label = 1; label <= count; ++label) {
      for (let at = 0; at < 27; ++at) {
        const [x, y, z] = [at % 3, Math.floor(at / 3) % 3, Math.floor(at / 9)];
        const place =
          (1 + z) * nx * ny + (1 + y + 5 * Math.floor((label - 1) / 20)) * nx + 1 + x + 5 * ((label - 1) % 20);
        voxels.writeUInt16LE(label, 2 * place);
      }
    }
    const name = path.join(folder, 'labels-300.nrrd');
    fs.writeFileSync(
      name,
      Buffer.concat([
        Buffer.from(
          `NRRD0004\ntype: uint16\ndimension: 3\nsizes: ${nx} ${ny} ${nz}\n` +
            'spacings: 1 1 1\nencoding: raw\nendian: little\n\n',
        ),
        voxels,
      ]),
    );
    const page = await open();
    await give(page, name);
    equal(await page.locator('#labels tbody tr').count(), count, 'labels listed');
    await page.fill('#find-label', 'label-29');
    equal(await page.locator('#labels tbody tr:visible').count(), 11, 'labels found: 29 and 290 to 299');
    await page.fill('#find-label', '');
    await want(page, 'core');
    await compute(page);
    equal(await page.locator('#certificate li').count(), count, 'certificates');
    equal(await page.textContent('#certificate-title'), `Result: ${count} of ${count} certified`, 'the heading');
    const frame = await viewer(page);
    equal(await frame.locator('#labels li').count(), count, 'labels in the viewer');
    await page.click('#no-labels');
    await page.locator('#labels tbody input').nth(6).check();
    await compute(page);
    equal(await page.locator('#certificate li').count(), 1, 'certificates of one chosen label');
    check((await page.textContent('#certificate')).includes('label-7'), 'another label was computed');
    await shot(page, 'labels-1440');
    await close(page);
  },

  async folders() {
    const own = fs.mkdtempSync(path.join(folder, 'folders-'));
    const page = await open();
    const giveFolder = async (name) => {
      await page.setInputFiles('#folder', path.join(own, name));
      await page.waitForSelector('#run:enabled, #failure:not([hidden])', { state: 'attached' });
      check(await page.isHidden('#failure'), `${name}: ${await page.textContent('#failure')}`);
    };
    // A header and its data, and a file that is no scan beside them.
    fs.mkdirSync(path.join(own, 'header'));
    const whole = execFileSync(program, ['phantom', 'ball', '--size', '16', '-o', path.join(own, 'ball.mhd')], {
      encoding: 'utf8',
    });
    check(whole.includes('16 x 16 x 16'), whole);
    const [voxels] = fs.readdirSync(own).filter((name) => /raw$/.test(name));
    for (const name of ['ball.mhd', voxels]) fs.renameSync(path.join(own, name), path.join(own, 'header', name));
    await giveFolder('header');
    check((await page.textContent('#what')).includes('16 × 16 × 16'), await page.textContent('#what'));
    check(await page.isHidden('#which'), 'the data are taken for another scan');
    await want(page, 'core');
    await compute(page);

    // Slices: grey BMP files.
    fs.mkdirSync(path.join(own, 'slices'));
    const [side, count] = [24, 5]; // squares of 4 to 12 voxels
    for (let k = 0; k < count; ++k) {
      const slice = Buffer.alloc(54 + 1024 + side * side);
      slice.write('BM');
      [
        [2, slice.length],
        [10, 54 + 1024],
        [14, 40],
        [18, side],
        [22, side],
        [46, 256],
      ].forEach(([at, value]) => slice.writeUInt32LE(value, at));
      slice.writeUInt16LE(1, 26);
      slice.writeUInt16LE(8, 28);
      for (let grey = 0; grey < 256; ++grey) slice.fill(grey, 54 + 4 * grey, 57 + 4 * grey);
      for (let y = 10 - k; y < 14 + k; ++y) {
        slice.fill(255, 54 + 1024 + side * y + 10 - k, 54 + 1024 + side * y + 14 + k);
      }
      fs.writeFileSync(path.join(own, 'slices', `slice-${k}.bmp`), slice);
    }
    await giveFolder('slices');
    check(
      (await page.textContent('#what')).includes(`${side} × ${side} × ${count}`),
      await page.textContent('#what'),
    );
    check((await page.textContent('#labels')).includes('360'), 'other voxels than the squares have');
    check((await page.textContent('#labels')).includes('vox³'), 'a scan without a voxel size has volumes in mm³');
    await compute(page);
    check((await page.textContent('#histograms')).includes('vox'), 'and radii in mm');

    // A file with names of labels.
    fs.writeFileSync(path.join(own, 'box.txt'), '1 Shoe box\n');
    await give(page, path.join(data, 'box.nrrd'), path.join(own, 'box.txt'));
    check(await page.isHidden('#which'), 'the names are taken for another scan');
    check((await page.textContent('#labels')).includes('Shoe'), 'the label has no name');

    // Several scans: one is chosen.
    await give(page, path.join(data, 'box.nrrd'), path.join(data, 'torus.nrrd'));
    await page.selectOption('#main-file', 'torus.nrrd');
    await page.waitForSelector('#run:enabled');
    await compute(page);
    check((await page.textContent('#certificate')).includes('1 loop'), 'the other scan was computed');

    // A threshold is another way to read the scan, which no preset changes.
    await page.fill('[data-option=threshold]', '5:inf');
    await page.locator('[data-option=threshold]').blur();
    await page.waitForSelector('#failure:not([hidden])', { state: 'attached' });
    check(await page.isDisabled('#run'), 'it can be run without a voxel');
    await page.check('input[name=preset][value=Bone]');
    equal(await page.inputValue('[data-option=threshold]'), '5:inf', 'the threshold after a preset');
    await page.fill('[data-option=threshold]', '1:inf');
    await page.locator('[data-option=threshold]').blur();
    await page.waitForSelector('#run:enabled');
    fs.rmSync(own, { recursive: true });
    await close(page);
  },

  async cancel() {
    const name = path.join(folder, 'long.nrrd');
    execFileSync(program, ['phantom', 'gyroid', '--size', '96', '-o', name, '--force']);
    const page = await open();
    await drop(page, name);
    await want(page, 'core', 'thickness');
    await page.click('#run');
    await page.waitForSelector('#stop:visible');
    await page.waitForFunction(() => document.getElementById('stage').textContent !== '');
    const start = Date.now();
    await page.click('#stop');
    await page.waitForSelector('#run:enabled');
    check(Date.now() - start < 3000, `it stopped after ${Date.now() - start} ms`);
    check((await page.textContent('#said')).startsWith('Stopped'), 'it does not say that it stopped');
    check((await page.isHidden('#shown')) && (await page.isHidden('#failure')), 'it shows something');
    await drop(page, path.join(data, 'torus.nrrd')); // and it goes on
    await want(page, 'core');
    await compute(page);
    await close(page);
  },

  async offline() {
    const page = await open();
    await page.evaluate(() => navigator.serviceWorker.ready.then(() => true));
    await page.context().setOffline(true);
    server.close();
    server.closeAllConnections();
    await page.reload();
    await page.waitForSelector('body[data-state=ready]');
    await page.click('#sample');
    await page.waitForSelector('#run:enabled');
    await want(page, 'skeleton');
    await compute(page);
    await viewer(page);
    await close(page);
  },

  async file() {
    const page = await open(pathToFileURL(path.join(folder, 'voxelcore.html')).href);
    await page.click('#sample');
    await page.waitForSelector('#run:enabled');
    await want(page, 'core', 'skeleton');
    await compute(page);
    await viewer(page);
    check(Object.keys(await filesOf(page)).length >= 6, 'files are missing');
    await page.click('#licences summary');
    const licences = page.locator('#licences pre');
    await licences.getByText('Apache License').first().waitFor();
    for (const name of ['libjs-three', 'fflate'])
      check((await licences.textContent()).includes(name), `no licence of ${name}`);
    await close(page);
  },

  async edits() {
    // A bar with a branch; both are clicked.
    const own = fs.mkdtempSync(path.join(folder, 'edits-'));
    const name = path.join(own, 'tee.nrrd');
    const [nx, ny, nz] = [60, 40, 16];
    const voxels = Buffer.alloc(nx * ny * nz);
    const tube = (a, b, radius) => Math.hypot(a, b) < radius;
    for (let z = 0, at = 0; z < nz; ++z)
      for (let y = 0; y < ny; ++y)
        for (let x = 0; x < nx; ++x, ++at)
          voxels[at] = (tube(y - 8, z - 8, 4.5) && x > 2 && x < 57) || (tube(x - 25, z - 8, 3.5) && y > 8 && y < 35) ? 1 : 0;
    const head = `NRRD0004\ntype: uint8\ndimension: 3\nsizes: ${nx} ${ny} ${nz}\nspacings: 1 1 1\nencoding: raw\n\n`;
    fs.writeFileSync(name, Buffer.concat([Buffer.from(head), voxels]));
    for (const width of [1440, 390]) {
      const page = await open(origin, { width });
      await give(page, name);
      await want(page, 'skeleton');
      await compute(page);
      const clickAt = async (place) => {
        const frame = await viewer(page);
        await page.locator('#viewer').scrollIntoViewIfNeeded();
        const [x, y] = await frame.evaluate((at) => {
          const box = Page.view.canvas.getBoundingClientRect();
          const [right, down] = Page.view.pixelsOf(at.map((v, k) => v - Page.meshes.middle[k]), 0);
          return [box.left + box.width / 2 + right, box.top + box.height / 2 + down];
        }, place);
        const box = await page.locator('#viewer').boundingBox();
        await page.mouse.click(box.x + x + 1, box.y + y + 1); // it has a border
        return frame;
      };
      let frame = await clickAt([25, 22, 8]);
      check((await frame.locator('#edit-row').textContent()).includes('Branch'), 'no branch was chosen');
      await frame.locator('#edit-choices [value=remove]').click();
      await frame.locator('#edit-apply').click();
      await page.waitForFunction(() => document.getElementById('said').textContent.startsWith('Computing'));
      await page.waitForFunction(() => document.getElementById('said').textContent.startsWith('Done'));
      check((await page.textContent('#certificate')).includes('certified'), 'no certificate');
      frame = await viewer(page);
      equal(await frame.evaluate(() => Page.model.labels[0].curves.numbers.length), 1, 'branches that are left');
      equal(await frame.locator('#edit-list li').count(), 1, 'edits that are listed');

      // Another, by keys; both are downloaded, and do the same in the program.
      await frame.locator('#correct').evaluate((button) => button.click()); // a phone's panel is folded
      await frame.locator('#edit-branch').fill('0');
      await frame.locator('#edit-choices [value=cut]').focus();
      await page.keyboard.press('Enter');
      equal(await frame.locator('#edit-list li').count(), 2, 'edits after another');
      const [saved] = await Promise.all([page.waitForEvent('download'), frame.locator('#edit-save').click()]);
      await saved.saveAs(path.join(own, 'edits.csv'));
      await shot(page, `edits-${width}`);
      await frame.locator('#edit-apply').click();
      await page.waitForFunction(() => document.getElementById('said').textContent.startsWith('Computing'));
      await page.waitForFunction(() => document.getElementById('said').textContent.startsWith('Done'));
      frame = await viewer(page);
      equal(await frame.evaluate(() => Page.model.labels[0].curves.numbers.length), 2, 'branches after a cut');
      const made = await filesOf(page);
      execFileSync(
        program,
        ['skeleton', name, '-o', path.join(own, 'native.vtp'), '--edits', path.join(own, 'edits.csv'), '--force',
          '--connectivity', 'joined'],
        { stdio: 'pipe' },
      );
      check(
        Buffer.compare(fs.readFileSync(path.join(own, 'native.vtp')), Buffer.from(made['tee_skeleton.vtp'])) === 0,
        'the program makes another tree of the same edits',
      );
      await close(page);
    }
    fs.rmSync(own, { recursive: true });
  },

  async phone() {
    const page = await open(origin, { width: 390, scheme: 'dark' });
    const wide = () => page.evaluate(() => document.documentElement.scrollWidth);
    check((await wide()) <= 390, `it is ${await wide()} pixels wide`);
    await page.focus('#sample'); // all by keys
    await page.keyboard.press('Enter');
    await page.waitForSelector('#run:enabled');
    await page.focus('input[name=preset]');
    await page.keyboard.press('ArrowDown');
    check(await page.isChecked('input[name=preset][value=Root]'), 'the arrow key chose another preset');
    await page.focus('#run');
    await page.keyboard.press('Enter');
    await page.waitForSelector('#shown:not([hidden])', { state: 'attached' });
    equal(await page.evaluate(() => document.activeElement.id), 'certificate-title', 'what has the focus');
    await viewer(page);
    check((await wide()) <= 390, `with a result it is ${await wide()} pixels wide`);
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll('button, input, select, progress, iframe, [role=region]')]
        .filter(
          (one) => !one.textContent.trim() && !one.getAttribute('aria-label') && !one.title && !one.labels?.length,
        )
        .map((one) => one.outerHTML),
    );
    equal(nameless.join(' '), '', 'without a name for screen readers');
    for (const role of ['status', 'alert', 'radiogroup', 'region'])
      check((await page.locator(`[role=${role}]`).count()) > 0, `no ${role}`);
    check(
      (await page.evaluate(() => getComputedStyle(document.body).backgroundColor)) === 'rgb(20, 23, 26)',
      'the ground is not dark',
    );
    await shot(page, 'phone-390');
    await close(page);
  },
};

let code = 0;
try {
  await parts[part]();
} catch (error) {
  console.error(error.stack);
  code = 1;
}
await browser.close();
process.exit(code);
