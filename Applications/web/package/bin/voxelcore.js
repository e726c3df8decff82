#!/usr/bin/env node
// The command line: `npx voxelcore core scan.nii.gz -o medial.vtp`.

import fs from 'node:fs';
import { Worker } from 'node:worker_threads';

const kInterrupted = 130;
const kToStop = 500; // ms for a job to stop by itself

const module = await WebAssembly.compile(fs.readFileSync(new URL('../voxelcore.wasm', import.meta.url)));
const stop = new Int32Array(new SharedArrayBuffer(4));
const worker = new Worker(new URL('../command.js', import.meta.url), {
  workerData: { module, args: process.argv.slice(2), stop },
});
const temporaries = new Set();

function endNow() {
  for (const file of temporaries) fs.rmSync(file, { force: true });
  process.stderr.write('voxelcore: interrupted; nothing was written\n', () => process.exit(kInterrupted));
}

async function stopNow() {
  await worker.terminate();
  endNow();
}

for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) {
  process.on(signal, () => {
    if (Atomics.exchange(stop, 0, 1) === 0 && signal === 'SIGINT') {
      setTimeout(stopNow, kToStop).unref();
    } else {
      stopNow();
    }
  });
}
worker.on('message', ({ temporary, code, errors }) => {
  if (temporary !== undefined) {
    temporaries.add(temporary);
  } else {
    for (const line of errors) process.stderr.write(`${line}\n`);
    process.exitCode = code;
  }
});
worker.on('error', (error) => {
  process.stderr.write(`voxelcore: internal error: ${error.message}; please report this with the scan\n`);
  process.exitCode = 1;
});
worker.on('exit', (code) => {
  process.exitCode ??= code;
});
