// The command line in a worker, so that the thread that started it can hear of Ctrl-C.

import { parentPort, workerData } from 'node:worker_threads';
import { useDisk } from './disk.js';
import { runProgram } from './engine.js';

globalThis.crypto ??= (await import('node:crypto')).webcrypto;
const { module, args, stop } = workerData;
const { code, errors } = await runProgram(module, args, {
  onDisk: (program) => useDisk(program, (temporary) => parentPort.postMessage({ temporary })),
  isCancelled: () => Atomics.load(stop, 0) === 1,
});
parentPort.postMessage({ code, errors });
