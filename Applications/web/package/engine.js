// Runs the program once, in the thread at hand, on files in memory or on disk.

import createVoxelCore from './voxelcore.js';

const folder = '/work';

const text = new TextDecoder();

/** Puts files where the program finds them: bytes in its memory, File and Blob by reference where a worker can read. */
function putFiles(FS, WORKERFS, files) {
  const blobs = [];
  for (const [name, data] of files) {
    const path = `${folder}/${name}`;
    FS.createPath('/', path.slice(1, path.lastIndexOf('/')), true, true);
    if (typeof Blob !== 'undefined' && data instanceof Blob) {
      blobs.push({ name: String(blobs.length), data });
      FS.symlink(`/blobs/${blobs.length - 1}`, path);
    } else {
      FS.writeFile(path, data instanceof Uint8Array ? data : new Uint8Array(data), { canOwn: true });
    }
  }
  if (blobs.length > 0) {
    FS.mkdir('/blobs');
    FS.mount(WORKERFS, { blobs }, '/blobs');
  }
}

/** Every file that was not given: [name, bytes]. */
function takeFiles(FS, given) {
  const found = [];
  const look = (path) => {
    for (const name of FS.readdir(path)) {
      if (name === '.' || name === '..') continue;
      const one = `${path}/${name}`;
      const { node } = FS.lookupPath(one, {});
      if (FS.isDir(node.mode)) {
        look(one);
      } else if (FS.isFile(node.mode) && given.get(one) !== node) {
        found.push([one.slice(folder.length + 1), FS.readFile(one)]);
      }
    }
  };
  look(folder);
  return found;
}

/** Bytes of a stream, and its lines as they come. */
function stream(onLine) {
  const bytes = [];
  let line = [];
  return {
    put(byte) {
      if (byte === null) return;
      bytes.push(byte);
      if (byte === 10) {
        onLine?.(text.decode(new Uint8Array(line)));
        line = [];
      } else {
        line.push(byte);
      }
    },
    text: () => text.decode(new Uint8Array(bytes)),
  };
}

/** A program that has not run yet. */
function load(module, parts) {
  return createVoxelCore({
    thisProgram: 'voxelcore',
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
      return {};
    },
    quit(_, reason) {
      throw reason;
    },
    ...parts,
  });
}

/** Puts files where the program runs. */
function give({ FS, WORKERFS }, files) {
  FS.createPath('/', folder.slice(1), true, true);
  putFiles(FS, WORKERFS, files);
  FS.chdir(folder);
}

/** The table of options: see index.d.ts. */
export async function readTable(module) {
  const program = await load(module, {});
  return JSON.parse(program.UTF8ToString(program._ParameterTable()));
}

/** A scan to be shown: see voxels() in index.d.ts. */
export async function readVoxels(module, args, most, files) {
  const program = await load(module, { stdin: () => null, stdout: () => {}, stderr: () => {} });
  give(program, files);
  const words = program.allocateUTF8(JSON.stringify({ args, most }));
  const { at, count, error, ...scan } = JSON.parse(program.UTF8ToString(program._ReadShownScan(words)));
  if (error !== undefined) throw new Error(error);
  return at === undefined ? null : { ...scan, values: program.HEAPU8.slice(at, at + count) };
}

/**
 * @param {WebAssembly.Module} module
 * @param {string[]} args as of the command line
 * @param {{files?: [string, Uint8Array|ArrayBuffer|Blob][], onErrorLine?: (line: string) => boolean | void,
 *   isCancelled?: () => boolean, onDisk?: (program: object) => void}} how  onDisk: takes the place of files in memory
 * @returns {Promise<{code: number, output: string, errors: string[], files: [string, Uint8Array][]}>}
 */
export async function runProgram(module, args, { files = [], onErrorLine, isCancelled, onDisk } = {}) {
  const errors = [];
  const output = stream();
  const error = stream((line) => {
    if (!onErrorLine?.(line)) errors.push(line);
  });
  const program = await load(module, {
    stdin: () => null,
    stdout: output.put,
    stderr: error.put,
    preRun: [(one) => {
      one.ENV.VOXELCORE_LIBRARY_MESSAGES = '1'; // the streams are not a console's, and need no copies
    }],
    isCancelled,
  });
  const { FS } = program;
  const given = new Map();
  if (onDisk) {
    onDisk(program);
  } else {
    give(program, files);
    for (const [name] of files) {
      const path = `${folder}/${name}`;
      given.set(path, FS.lookupPath(path, {}).node);
    }
  }
  let code;
  try {
    code = program.callMain(args);
  } catch (reason) {
    const isMemory = reason instanceof RangeError || /memory/i.test(String(reason));
    const why = isMemory ? 'the memory is used up' : 'the program crashed';
    errors.push(`voxelcore: internal error: ${why}; nothing was written; please report this with the scan`);
    code = 1;
  }
  return { code, output: output.text(), errors, files: onDisk ? [] : takeFiles(FS, given) };
}
