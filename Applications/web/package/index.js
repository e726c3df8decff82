// VoxelCore in a page and in Node: the program itself, with the files that it reads and writes in memory.

import { readVtp } from './vtp.js';

export { readVtp };

const isNode = typeof process === 'object' && process.versions?.node !== undefined;
const kMostIdle = 4; // workers that wait for the next run

const idle = [];
let compiled;
let settings = {};

/** Where the parts are, when they do not lie beside this file: see index.d.ts. */
export function configure(given) {
  settings = { ...settings, ...given };
  compiled = undefined;
}

async function compile() {
  const { wasm } = settings;
  if (wasm instanceof WebAssembly.Module) return wasm;
  if (wasm instanceof Uint8Array || wasm instanceof ArrayBuffer) return WebAssembly.compile(wasm);
  const place = wasm ?? new URL('./voxelcore.wasm', import.meta.url);
  if (isNode) {
    const { readFile } = await import('node:fs/promises');
    return WebAssembly.compile(await readFile(place));
  }
  const answer = await fetch(place);
  if (!answer.ok) throw new Error(`${place}: ${answer.status} ${answer.statusText}`);
  return WebAssembly.compile(await answer.arrayBuffer());
}

/** A worker with one way of listening, in a page and in Node. */
async function startWorker() {
  if (settings.worker) return settings.worker();
  if (!isNode) return new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  const { Worker: NodeWorker } = await import('node:worker_threads');
  return new NodeWorker(new URL('./worker.js', import.meta.url));
}

function listen(worker, onMessage, onError) {
  if (isNode) {
    worker.removeAllListeners('message');
    worker.removeAllListeners('error');
    worker.on('message', onMessage);
    worker.on('error', onError);
  } else {
    worker.onmessage = ({ data }) => onMessage(data);
    worker.onerror = (event) => onError(new Error(event.message ?? 'the worker failed'));
  }
}

/** What the program says when it fails: its line, and its exit code. */
export class VoxelCoreError extends Error {
  constructor(code, errors) {
    super((errors.at(-1) ?? `voxelcore: ended with exit code ${code}`).replace(/^voxelcore: /, ''));
    this.name = 'VoxelCoreError';
    this.code = code;
    this.errors = errors;
  }
}

/** ["--lambda=1vox", "--force"] of {lambda: "1vox", force: true}. */
export function argumentsOf(options = {}) {
  return Object.entries(options).flatMap(([name, value]) => {
    const flag = `--${name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}`;
    if (value === undefined || value === null || value === false) return [];
    if (value === true) return [flag];
    return [`${flag}=${Array.isArray(value) ? value.join(',') : value}`];
  });
}

/** [[name, data]] of what may be given as a scan, and the argument that names it. */
async function scanOf(scan) {
  if (isNode && typeof scan === 'string') {
    const { readFile } = await import('node:fs/promises');
    const { basename } = await import('node:path');
    return { name: basename(scan), files: [[basename(scan), new Uint8Array(await readFile(scan))]] };
  }
  if (typeof File !== 'undefined' && scan instanceof File) return { name: scan.name, files: [[scan.name, scan]] };
  if (scan?.name !== undefined && scan?.data !== undefined) return { name: scan.name, files: [[scan.name, scan.data]] };
  const list = Array.isArray(scan) ? scan : [];
  const files = list.map((file) => [file.webkitRelativePath || file.name, file.data ?? file]);
  if (files.length === 0) throw new TypeError('a scan is a File, {name, data}, or a list of them; in Node a path, too');
  const [first] = files[0];
  const at = first.indexOf('/');
  const folder = at > 0 && files.every(([name]) => name.startsWith(first.slice(0, at + 1))) ? first.slice(0, at) : '.';
  return { name: files.length === 1 ? first : folder, files };
}

/** Has a worker do what `message` says. */
async function work(message, { onProgress, signal } = {}) {
  signal?.throwIfAborted();
  compiled ??= compile();
  const module = await compiled;
  const worker = idle.pop() ?? (await startWorker());
  if (isNode) worker.ref();
  const done = await new Promise((resolve, reject) => {
    const end = (call) => (value) => {
      signal?.removeEventListener('abort', abort);
      call(value);
    };
    const fail = (reason) => {
      worker.terminate();
      end(reject)(reason);
    };
    const abort = () => fail(signal.reason);
    signal?.addEventListener('abort', abort, { once: true });
    listen(worker, ({ step, failed, done: result }) => {
      if (step) {
        onProgress?.(step.stage, step.fraction);
      } else if (failed) {
        fail(new Error(failed));
      } else {
        end(resolve)(result);
      }
    }, fail);
    worker.postMessage({ module, ...message });
  });
  if (idle.length < kMostIdle) {
    if (isNode) worker.unref();
    idle.push(worker);
  } else {
    worker.terminate();
  }
  return done;
}

/** All commands and options: see index.d.ts. */
export function table() {
  return work({});
}

/** Only a page's worker reads a Blob piece by piece. */
const readable = async (data) => (isNode && data instanceof Blob ? new Uint8Array(await data.arrayBuffer()) : data);

/** Runs a command line: see index.d.ts. */
export async function run(args, files = [], { onProgress, signal, allowFailure = false } = {}) {
  const saysProgress = onProgress && args.length > 0 && !args[0].startsWith('-') &&
    !args.some((arg) => arg.startsWith('--progress'));
  const words = saysProgress ? [args[0], '--progress=json', ...args.slice(1)] : args;
  const given = await Promise.all([...files].map(async ([name, data]) => [name, await readable(data)]));
  const done = await work({ args: words, files: given }, { onProgress, signal });
  if (done.code !== 0 && !allowFailure) throw new VoxelCoreError(done.code, done.errors);
  const warning = 'voxelcore: warning: ';
  return {
    code: done.code,
    text: done.output,
    errors: done.errors,
    warnings: done.errors.filter((line) => line.startsWith(warning)).map((line) => line.slice(warning.length)),
    files: Object.fromEntries(done.files),
  };
}

const kMostShown = 256e6; // voxels

/** A scan to be shown: see index.d.ts. */
export async function voxels(args, files, { signal, most = kMostShown } = {}) {
  const given = await Promise.all([...files].map(async ([name, data]) => [name, await readable(data)]));
  return work({ args, files: given, most }, { signal });
}

const decoded = (bytes) => JSON.parse(new TextDecoder().decode(bytes));

/** A command that reads a scan, and writes what `outputs` names unless it is asked for otherwise. */
async function runOn(command, scan, options, outputs, running, others = []) {
  const { name, files } = await scanOf(scan);
  const all = { ...outputs, ...options };
  const result = await run([command, ...argumentsOf(all), '--', name, ...others.map(([other]) => other)],
    [...files, ...others], running);
  const written = result.files;
  return {
    ...result,
    ...(written[all.report] && { report: decoded(written[all.report]) }),
    ...(written[all.output]?.length && all.output.endsWith('.vtp') && { mesh: await readVtp(written[all.output]) }),
  };
}

export async function info(scan, options, running) {
  return JSON.parse((await runOn('info', scan, { ...options, json: true }, {}, running)).text);
}

export function core(scan, options, running) {
  return runOn('core', scan, options, { output: 'core.vtp', report: 'core.json' }, running);
}

export function skeleton(scan, options, running) {
  return runOn('skeleton', scan, options, { output: 'skeleton.vtp', report: 'skeleton.json' }, running);
}

export function sheets(scan, options, running) {
  return runOn('sheets', scan, options, { output: 'sheets.vtp', report: 'sheets.json' }, running);
}

export function thickness(scan, options, running) {
  return runOn('thickness', scan, options, { output: 'thickness.nrrd', report: 'thickness.json' }, running);
}

export async function roots(scan, options, running) {
  const result = await runOn('roots', scan, options, { output: 'roots' }, running);
  const report = Object.entries(result.files).find(([name]) => name.endsWith('report.json'));
  return { ...result, ...(report && { report: decoded(report[1]) }) };
}

export async function verify(scan, model, options, running) {
  const other = model instanceof Uint8Array ? ['core.vtp', model] : (await scanOf(model)).files[0];
  const result = await runOn('verify', scan, options, {}, { ...running, allowFailure: true }, [other]);
  if (result.code !== 0 && result.code !== 4) throw new VoxelCoreError(result.code, result.errors);
  return { ...result, agrees: result.code === 0 };
}
