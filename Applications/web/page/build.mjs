// Makes the page: a folder for any web server, and one HTML file.
// usage: node build.mjs PACKAGE OUT    PACKAGE: what build.sh made; OUT gets folder page and voxelcore.html

import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import zlib from 'node:zlib';

const here = path.dirname(fileURLToPath(import.meta.url));
const root = path.join(here, '../../..');
const [packageFolder, out] = process.argv.slice(2).map((name) => path.resolve(name));
const read = (...names) => fs.readFileSync(path.join(...names), 'utf8');

// The libraries, as package-lock.json has them.
const tools = path.join(out, 'tools');
fs.mkdirSync(tools, { recursive: true });
const lock = path.join(tools, 'package-lock.json');
const isSame = fs.existsSync(lock) && read(lock) === read(here, 'package-lock.json');
for (const name of ['package.json', 'package-lock.json']) fs.copyFileSync(path.join(here, name), path.join(tools, name));
if (!isSame || !fs.existsSync(path.join(tools, 'node_modules'))) {
  execFileSync('npm', ['ci', '--no-audit', '--no-fund', '--loglevel=error'], {
    cwd: tools,
    stdio: ['ignore', 'ignore', 'inherit'],
  });
}
const { buildSync } = await import(path.join(tools, 'node_modules/esbuild/lib/main.js'));

const bundle = (entry, format) =>
  buildSync({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    format,
    write: false,
    target: 'es2022',
    external: ['node:*', 'module', 'fs', 'path', 'url', 'crypto', 'worker_threads'],
    define: { 'import.meta.url': '""' },
    nodePaths: [path.join(tools, 'node_modules')],
    alias: { voxelcore: path.join(packageFolder, 'index.js') },
    logLevel: 'error',
    legalComments: 'none',
  }).outputFiles[0].text;

// The viewer of the offline page, and what this page has besides.
const display = path.join(root, 'Modules/Models/Display/src/page');
const scripts = [
  [display, 'data.js'],
  [here, 'names.js'],
  [display, 'meshes.js'],
  [display, 'overlay.js'],
  [display, 'view.js'],
  [display, 'panel.js'],
  [display, 'edits.js'],
  [here, 'threshold.js'],
  [here, 'place.js'],
]
  .map((names) => read(...names))
  .join('');
let viewer = read(display, 'page.html');
for (const [mark, text] of [
  ['@VIEWER@', scripts],
  ['@THREE@', read('/usr/share/javascript/three/three.min.js')],
  ['@FIGURES@', ''],
  ['@STYLE@', read(display, 'page.css')],
]) {
  if (!viewer.includes(mark)) throw new Error(`the offline page lacks its mark ${mark}`);
  viewer = viewer.replace(mark, () => text);
}

// The presets of Slicer's module: name, text, and what is run with which options.
const presets = execFileSync(
  'python3',
  [
    '-c',
    `
import importlib.util, json, sys
spec = importlib.util.spec_from_file_location("Settings", sys.argv[1])
module = sys.modules["Settings"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
def ours(options):
    return {name: value for name, value in options.items() if name != "threads"}
print(json.dumps({name: {"text": text, "steps": [[command, ours(options)] for command, options in settings.steps()]}
                  for name, (text, settings) in module.PRESETS.items()}))
`,
    path.join(root, 'Applications/slicer/VoxelCore/VoxelCoreLib/Settings.py'),
  ],
  { encoding: 'utf8' },
);

// The colours of lengths, at equal steps, by the polynomial that the program has.
function lengthColors() {
  const source = read(root, 'Modules/Models/Models/src/DisplayColors.cxx');
  const table = /LengthColor[\s\S]*?coefficients\{ \{([\s\S]*?)\n {2}\} \};/.exec(source)?.[1];
  const rows = [...(table ?? '').matchAll(/\{ ([^{}]*) \}/g)].map(([, row]) => row.split(',').map(Number));
  const [first, last] = ['kFirst', 'kLast'].map((name) =>
    Number(new RegExp(`${name} = ([0-9.]+);`).exec(source)?.[1]),
  );
  if (rows.length !== 7 || rows.flat().some(Number.isNaN) || !(last > first))
    throw new Error('DisplayColors.cxx has another form');
  const steps = 65;
  return Array.from({ length: steps }, (_, i) => {
    const at = first + ((last - first) * i) / (steps - 1);
    const parts = [0, 1, 2].map((c) =>
      Math.min(
        1,
        Math.max(
          0,
          rows.reduceRight((sum, row) => sum * at + row[c], 0),
        ),
      ),
    );
    return `#${parts
      .map((value) =>
        Math.round(255 * value)
          .toString(16)
          .padStart(2, '0'),
      )
      .join('')}`;
  });
}

// The licences of all that is in the page.
const licences = [
  path.join(packageFolder, 'LICENSE'),
  ...fs.readdirSync(path.join(packageFolder, 'licences')).map((name) => path.join(packageFolder, 'licences', name)),
  '/usr/share/doc/libjs-three/copyright',
  path.join(tools, 'node_modules/fflate/LICENSE'),
].map((name) => `==== ${path.relative(root, name).replace(/^.*\/(?=[^/]*\/[^/]*$)/, '')} ====\n\n${read(name)}`);

const parts = {
  'voxelcore.wasm': fs.readFileSync(path.join(packageFolder, 'voxelcore.wasm')),
  'worker.js': bundle(path.join(packageFolder, 'worker.js'), 'iife'),
  'viewer.html': viewer,
  'presets.json': presets,
  'licences.txt': licences.join('\n\n'),
  'colors.json': JSON.stringify(lengthColors()),
  'sample-root.nrrd': fs.readFileSync(path.join(root, 'Data/root.nrrd')),
};
const packed = Object.fromEntries(
  Object.entries(parts).map(([name, data]) => [name, zlib.gzipSync(data, { level: 9 })]),
);
const main = bundle(path.join(here, 'main.js'), 'esm');
const { version } = JSON.parse(read(packageFolder, 'package.json'));
const html = (marks) =>
  Object.entries({ '@VERSION@': version, ...marks }).reduce(
    (text, [mark, value]) => text.replace(mark, () => value),
    read(here, 'index.html'),
  );
// Frames have the rules of the page around them, and the offline page's scripts are in its text.
const policy = (own, fetched) =>
  `default-src 'none'; script-src ${own}'unsafe-inline' 'wasm-unsafe-eval' blob:; ` +
  `style-src ${own}'unsafe-inline'; img-src ${own}data: blob:; worker-src ${own}blob:; connect-src ${fetched}; ` +
  `frame-src ${own}blob:; manifest-src ${fetched}; base-uri 'none'; form-action 'none'`;

// A folder.
const folder = path.join(out, 'page');
fs.rmSync(folder, { recursive: true, force: true });
fs.mkdirSync(folder, { recursive: true });
const served = {
  'index.html': html({
    '@POLICY@': policy("'self' ", "'self'"),
    '@HEAD@':
      '<link rel="stylesheet" href="page.css"><link rel="icon" href="icon.png">' +
      '<link rel="manifest" href="manifest.webmanifest">',
    '@SCRIPT@': '<script type="module" src="main.js"></script>',
  }),
  'main.js': main,
  'page.css': read(here, 'page.css'),
  'manifest.webmanifest': read(here, 'manifest.webmanifest'),
  'icon.png': fs.readFileSync(path.join(root, 'Applications/slicer/VoxelCore/Resources/Icons/VoxelCore.png')),
  ...Object.fromEntries(Object.entries(packed).map(([name, data]) => [`${name}.gz`, data])),
};
const digest = createHash('sha256');
for (const [name, data] of Object.entries(served)) {
  digest.update(name).update(data);
  fs.writeFileSync(path.join(folder, name), data);
}
fs.writeFileSync(
  path.join(folder, 'sw.js'),
  read(here, 'sw.js')
    .replace('@DIGEST@', digest.digest('hex').slice(0, 16))
    .replace('@FILES@', JSON.stringify(['./', ...Object.keys(served)])),
);

// One file.
const inside = Object.entries(packed)
  .map(([name, data]) => `<script type="text/plain" id="part-${name}">${data.toString('base64')}</script>`)
  .join('\n');
fs.writeFileSync(
  path.join(out, 'voxelcore.html'),
  html({
    '@POLICY@': policy('', "'none'"),
    '@HEAD@': `<style>\n${read(here, 'page.css')}</style>`,
    '@SCRIPT@': `${inside}\n<script type="module">${main.replaceAll('</script', '<\\/script')}</script>`,
  }),
);

const size = (names) =>
  names.reduce((sum, name) => sum + zlib.gzipSync(fs.readFileSync(name), { level: 9 }).length, 0);
console.log(`${folder}: ${size(Object.keys(served).map((name) => path.join(folder, name)))} bytes compressed`);
console.log(`${path.join(out, 'voxelcore.html')}: ${fs.statSync(path.join(out, 'voxelcore.html')).size} bytes`);
