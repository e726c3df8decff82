// The packed package in an empty folder: its command line and its API give what the program gives, and say what it
// says.
// usage: node package_test.mjs FOLDER_OF_THE_BUILD VOXELCORE DATA

import assert from 'node:assert/strict';
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import zlib from 'node:zlib';

const [build, program, data] = process.argv.slice(2).map((name) => path.resolve(name));
const place = fs.mkdtempSync(path.join(os.tmpdir(), 'voxelcore-package-'));
process.on('exit', () => fs.rmSync(place, { recursive: true, force: true }));
process.chdir(place);

const packed = fs.readFileSync(path.join(build, 'packed'), 'utf8').trim();
fs.writeFileSync('package.json', '{"private": true}');
execFileSync('npm', ['install', '--offline', '--no-audit', '--no-fund', path.join(build, packed)], { stdio: 'pipe' });
const installed = path.join(place, 'node_modules/voxelcore');
const command = path.join(place, 'node_modules/.bin/voxelcore');
const bytes = fs.statSync(path.join(build, packed)).size;
assert.ok(bytes < 5e6, `the package has ${bytes} bytes`);
const api = await import(pathToFileURL(path.join(installed, 'index.js')));

const tested = [];
async function test(name, body) {
  await body();
  tested.push(name);
  console.log(`passed: ${name}`);
}

const options = { encoding: 'utf8', maxBuffer: 1 << 28 };
const runs = (folder, words) => [program, command].map((one, index) => {
  const cwd = path.join(place, folder, String(index));
  fs.mkdirSync(cwd, { recursive: true });
  return { cwd, ...spawnSync(one, words, { ...options, cwd }) };
});

/** What differs from run to run is taken out. */
function content(file) {
  const read = fs.readFileSync(file);
  if (file.endsWith('.json') && !file.endsWith('.mrk.json')) {
    const varying = new Set(['seconds', 'peak_memory_mb', 'threads', 'memory_bytes', 'prediction', 'command']);
    return JSON.stringify(JSON.parse(read), (key, value) => (varying.has(key) ? undefined : value));
  }
  return read.toString('latin1');
}

function filesIn(folder) {
  return fs.readdirSync(folder, { recursive: true }).map(String).sort()
    .filter((name) => fs.statSync(path.join(folder, name)).isFile() && !/\.(png|html)$/.test(name));
}

function sameFiles(one, other) {
  assert.deepEqual(filesIn(one), filesIn(other));
  for (const name of filesIn(one)) {
    assert.ok(content(path.join(one, name)) === content(path.join(other, name)), `${name} differs`);
  }
}

fs.copyFileSync(path.join(data, 'root.nrrd'), 'root.nrrd');
fs.copyFileSync(path.join(data, 'capsule.mha'), 'capsule.mha');
const scan = path.join(place, 'root.nrrd');
const capsule = path.join(place, 'capsule.mha');

await test('commands write the same bytes', () => {
  for (const words of [
    ['phantom', 'ellipsoid', '--size', '40', '-o', 'phantom.nii.gz'],
    ['core', scan, '-o', 'core.vtp', '--report', 'core.json', '--table', 'core.csv'],
    ['skeleton', scan, '-o', 's.vtp', '--also', 'csv,swc,mrk.json,graphml'],
    ['roots', scan, '-o', 'roots', '--no-pictures'],
    ['thickness', capsule, '-o', 't.nrrd', '--table', 't.csv'],
    ['sheets', capsule, '-o', 'sheets.vtp', '--table', 'sheets.csv'],
  ]) {
    const [native, node] = runs(words[0], words);
    assert.equal(node.status, 0, node.stderr);
    assert.equal(native.status, 0, native.stderr);
    sameFiles(native.cwd, node.cwd);
  }
});

await test('the API gives the same bytes, and their arrays', async () => {
  const steps = [];
  const core = await api.core(scan, {}, { onProgress: (stage, fraction) => steps.push([stage, fraction]) });
  assert.ok(Buffer.from(core.files['core.vtp']).equals(fs.readFileSync(path.join(place, 'core/0/core.vtp'))));
  assert.ok(steps.length > 3 && steps.every(([stage, fraction]) => stage !== '' && fraction >= 0 && fraction <= 1));
  assert.equal(core.mesh.points.length % 3, 0);
  assert.equal(core.mesh.pointArrays.Radius.length, core.mesh.points.length / 3);
  assert.equal(core.mesh.polys.connectivity.length, core.mesh.polys.offsets.at(-1));
  assert.equal(core.report.labels[0].name, 'label-1');
  assert.equal((await api.verify(scan, core.files['core.vtp'])).agrees, true);
  const other = await api.core(capsule);
  assert.equal((await api.verify(scan, other.files['core.vtp'])).agrees, false);
  const skeleton = await api.skeleton({ name: 'root.nrrd', data: fs.readFileSync(scan) },
    { output: 's.vtp', also: ['csv', 'swc'] });
  for (const name of ['s.vtp', 's.swc', 's_branches.csv']) {
    assert.ok(Buffer.from(skeleton.files[name]).equals(fs.readFileSync(path.join(place, 'skeleton/0', name))), name);
  }
  assert.ok(skeleton.mesh.lines.offsets.length > 2);
  const thickness = await api.thickness(capsule, { table: 't.csv' });
  assert.ok(Buffer.from(thickness.files['t.csv']).equals(fs.readFileSync(path.join(place, 'thickness/0/t.csv'))));
  const roots = await api.roots(scan, { noPictures: true });
  assert.ok(Buffer.from(roots.files['roots/roots.csv'])
    .equals(fs.readFileSync(path.join(place, 'roots/0/roots/roots.csv'))));
  const info = await api.info(new File([fs.readFileSync(scan)], 'root.nrrd'));
  assert.deepEqual(info.size, [96, 96, 128]);
  const { commands, options: rows } = await api.table();
  const help = execFileSync(program, ['core', '--help'], options);
  assert.ok(commands.length > 10);
  for (const row of rows.filter((one) => one.commands.includes('core') && one.flags !== '')) {
    assert.ok(help.includes(row.flags), row.flags);
  }
});

await test('voxels to be shown are those of the file', async () => {
  const [nx, ny, nz] = [7, 5, 6];
  const seed = Number(process.env.VOXELCORE_SEED ?? Date.now() % 1000000);
  console.log(`seed ${seed}`);
  const stored = Int16Array.from({ length: nx * ny * nz }, (_, i) => ((i + seed) * 7919) % 4 * 250);
  const head = `NRRD0004\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: ${nx} ${ny} ${nz}\n` +
    'space directions: (0,0,2) (-3,0,0) (0,1,0)\nspace origin: (1,2,3)\nendian: little\nencoding: raw\n\n';
  const file = ['some.nrrd', new Uint8Array(Buffer.concat([Buffer.from(head), Buffer.from(stored.buffer)]))];
  const shown = await api.voxels(['--', 'some.nrrd'], [file]);
  assert.deepEqual([shown.size, shown.step, shown.origin, shown.unit], [[nx, ny, nz], 1, [1, 2, 3], 'mm']);
  assert.deepEqual(shown.axes, [[0, 0, 2], [-3, 0, 0], [0, 1, 0]]);
  assert.deepEqual([...shown.labels].sort((a, b) => a - b), [250, 500, 750]);
  assert.deepEqual(Array.from(shown.values, (code) => (code === 0 ? 0 : shown.labels[code - 1])), [...stored]);
  const few = await api.voxels(['--', 'some.nrrd'], [file], { most: 40 });
  assert.deepEqual([few.size, few.step, few.axes], [[4, 3, 3], 2, [[0, 0, 4], [-6, 0, 0], [0, 2, 0]]]);
  few.values.forEach((code, i) => {
    const [x, y, z] = [i % 4, Math.floor(i / 4) % 3, Math.floor(i / 12)];
    assert.equal(code === 0 ? 0 : few.labels[code - 1], stored[2 * x + nx * (2 * y + ny * 2 * z)]);
  });
  const grey = await api.voxels(['--threshold=100:inf', '--', 'some.nrrd'], [file]);
  assert.deepEqual([grey.window, grey.labels], [[0, 750], undefined]);
  grey.values.forEach((code, i) => assert.ok(Math.abs(code * 750 / 255 - stored[i]) < 3));
  assert.equal(await api.voxels(['--', 'one.obj'],
    [['one.obj', new TextEncoder().encode('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')]]), null);
  await assert.rejects(api.voxels(['--', 'no.nrrd'], [['no.nrrd', new TextEncoder().encode('hello')]]), /no\.nrrd/);
});

await test('bad files and words get the line and the exit code of the program', async () => {
  const nifti = Buffer.alloc(352);
  nifti.writeInt32LE(348, 0);
  [3, 32767, 32767, 32767, 1, 1, 1, 1].forEach((size, index) => nifti.writeInt16LE(size, 40 + 2 * index));
  nifti.writeInt16LE(2, 70);
  nifti.writeInt16LE(8, 72);
  for (let index = 1; index < 4; ++index) nifti.writeFloatLE(1, 76 + 4 * index);
  nifti.writeFloatLE(352, 108);
  nifti.write('n+1\0', 344, 'latin1');
  const nrrd = (sizes, rest = '') => `NRRD0004\ntype: uchar\ndimension: 3\nsizes: ${sizes}\nencoding: raw\n${rest}\n`;
  const bad = {
    'empty.nrrd': '', 'short.nrrd': nrrd('40 40 40'), 'huge.nrrd': nrrd('2000000 2000000 2000000'),
    'wide.nrrd': nrrd('65536 65536 65536'), 'minus.nrrd': nrrd('-3 4 4'), 'words.nrrd': nrrd('a b c'),
    'no.nrrd': 'hello', 'junk.nii.gz': 'junk', 'huge.nii': nifti, 'huge.nii.gz': zlib.gzipSync(nifti),
    'cut.nii.gz': zlib.gzipSync(nifti).subarray(0, 60), 'gone.mha': 'ObjectType = Image\nNDims = 3\n',
    'lost.mhd': 'ObjectType = Image\nNDims = 3\nDimSize = 4 4 4\nElementType = MET_UCHAR\nElementDataFile = lost.raw\n',
    'junk.mgz': 'junk', 'junk.npy': '\x93NUMPY\x01\x00', 'junk.tif': 'II*\0', 'junk.png': '\x89PNG\r\n',
    'junk.jpg': '\xff\xd8\xff\xe0junk', 'junk.vti': '<VTKFile type="ImageData">',
    'junk.stl': 'solid', 'junk.ply': 'ply\nformat ascii 1.0\n',
    'zero.nrrd': nrrd('4 4 4') + '\0'.repeat(64),
  };
  for (const [name, text] of Object.entries(bad)) fs.writeFileSync(name, text, 'latin1');
  const cases = Object.keys(bad).map((name) => ['core', path.join(place, name), '-o', 'o.vtp']);
  cases.push(['core', 'missing.nrrd', '-o', 'o.vtp'], ['core', scan], ['core', scan, '-o', 'o.xyz'], ['cor', scan], [],
    ['core', scan, '-o', 'nowhere/o.vtp'], ['core', scan, '-o', 'o.vtp', '--lambda', 'much'],
    ['core', scan, '-o', 'o.vtp', '--lamda', '1'], ['verify', scan, path.join(place, 'no.nrrd')],
    ['core', scan, '-o', 'o.vtp', '--labels', '7'], ['skeleton', scan, '-o', '/proc/o.vtp']);
  for (const words of cases) {
    const [native, node] = runs('bad', words);
    assert.equal(node.stderr, native.stderr, words.join(' '));
    assert.equal(node.status, native.status, words.join(' '));
    assert.deepEqual(filesIn(node.cwd), [], words.join(' '));
  }
  await assert.rejects(api.core({ name: 'no.nrrd', data: new TextEncoder().encode('hello') }),
    (error) => error instanceof api.VoxelCoreError && error.code === 3 && error.message.startsWith('no.nrrd: '));
  for (const words of [['render', 'x.vtp', '-o', 'x.png'], ['batch', scan, '-o', 'cohort'],
    ['core', scan, '-o', 'o.vtp', '--engine', 'tetgen'], ['core', scan, '-o', 'o.vtp', '--html', 'o.html']]) {
    const { status, stderr } = spawnSync(command, words, options);
    assert.ok([1, 2, 3].includes(status), `${words}: ${status}`);
    assert.match(stderr, /^voxelcore: .*\n$/, words.join(' '));
  }
});

await test('a run can be ended', async () => {
  const big = path.join(place, 'big.nrrd');
  execFileSync(program, ['phantom', 'gyroid', '--size', '128', '-o', big]);
  const ending = new AbortController();
  const start = Date.now();
  const ended = api.core(big, {}, { signal: ending.signal, onProgress: () => ending.abort(new Error('enough')) });
  await assert.rejects(ended, /enough/);
  assert.ok(Date.now() - start < 10000);
  assert.equal((await api.info(scan)).size.length, 3); // and others go on
  fs.mkdirSync('ended');
  const child = spawn(command, ['core', big, '-o', 'o.vtp', '--progress', 'plain'],
    { cwd: path.join(place, 'ended'), stdio: ['ignore', 'ignore', 'pipe'] });
  let said = '';
  child.stderr.on('data', (text) => {
    if (said === '') child.kill('SIGINT');
    said += text;
  });
  const code = await new Promise((resolve) => { child.on('close', resolve); });
  assert.equal(code, 130, said);
  assert.match(said, /voxelcore: interrupted; nothing was written\n$/);
  assert.deepEqual(fs.readdirSync('ended'), []);
});

console.log(`${tested.length} passed, 0 failed`);
process.exit(0);
