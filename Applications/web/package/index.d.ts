// VoxelCore in a page and in Node. Lengths are in mm, positions in files are LPS. The options are those of --help, by
// name: `lambda`, `withSkeleton` or 'with-skeleton', ...; their types are in options.d.ts.

import type {
  CoreOptions, InfoOptions, RootsOptions, SheetsOptions, SkeletonOptions, ThicknessOptions, VerifyOptions,
} from './options.js';

export * from './options.js';

/** A file: in a page one that was dropped or chosen, else its name and its bytes. */
export type NamedFile = File | { name: string; data: Uint8Array | ArrayBuffer | Blob };

/** A scan: one file, the files of a folder or of a header and its data; in Node also the path of a file. */
export type Scan = NamedFile | NamedFile[] | string;

export interface Running {
  /** Each stage of the work, and how far it is, from 0 to 1. */
  onProgress?(stage: string, fraction: number): void;
  /** Ends the run at once; its promise is rejected with the signal's reason. */
  signal?: AbortSignal;
}

export interface Result {
  /** Exit code of the program: 0; with `allowFailure`, 1 failed, 2 wrong usage, 3 input unfit, 4 a check disagrees. */
  code: number;
  /** What it printed. */
  text: string;
  /** Lines that it said besides, warnings and errors. */
  errors: string[];
  /** The warnings among them. */
  warnings: string[];
  /** Every file it wrote, by its name. */
  files: Record<string, Uint8Array>;
}

/** Cells: those of number i are connectivity[offsets[i]] to connectivity[offsets[i + 1] - 1], indices of points. */
export interface Cells {
  offsets: Int32Array;
  connectivity: Int32Array;
}

export type Values = Float64Array | Float32Array | Int32Array | Uint8Array;

/** What a .vtp holds. Cells are counted through verts, lines and polys in this order. */
export interface Mesh {
  /** x, y, z of each point */
  points: Values;
  verts: Cells;
  lines: Cells;
  polys: Cells;
  pointArrays: Record<string, Values>;
  cellArrays: Record<string, Values>;
  fields: Record<string, Values | string[]>;
  /** Of arrays with several numbers for each point or cell: how many. */
  components: Record<string, number>;
}

/** A run that wrote a surface or lines, and a report. */
export interface ModelResult extends Result {
  /** What the .vtp holds that was written; none where another format was asked for. */
  mesh?: Mesh;
  /** The program's report. */
  report?: any;
}

/** The program ended with an error: `message` is its line, `code` its exit code, `errors` all its lines. */
export class VoxelCoreError extends Error {
  code: number;
  errors: string[];
}

/** Runs a command line: `run(['core', 'scan.nrrd', '-o', 'core.vtp'], [['scan.nrrd', bytes]])`. Files lie in the folder
 *  it runs in. Rejects with VoxelCoreError unless `allowFailure` is given. */
export function run(
  args: string[],
  files?: Iterable<[string, Uint8Array | ArrayBuffer | Blob]>,
  running?: Running & { allowFailure?: boolean },
): Promise<Result>;

/** What is in a scan: size, spacing, labels, volumes, and the time and memory it will need. */
export function info(scan: Scan, options?: InfoOptions, running?: Running): Promise<any>;
/** The medial surface: core.vtp, core.json. */
export function core(scan: Scan, options?: CoreOptions, running?: Running): Promise<ModelResult>;
/** The curve skeleton: skeleton.vtp, skeleton.json. */
export function skeleton(scan: Scan, options?: SkeletonOptions, running?: Running): Promise<ModelResult>;
/** Sheets, seams and rods: sheets.vtp, sheets.json. */
export function sheets(scan: Scan, options?: SheetsOptions, running?: Running): Promise<ModelResult>;
/** Local thickness at each voxel: thickness.nrrd, thickness.json. */
export function thickness(scan: Scan, options?: ThicknessOptions, running?: Running): Promise<ModelResult>;
/** A plant's roots, apart and measured: the files of folder roots. */
export function roots(scan: Scan, options?: RootsOptions, running?: Running): Promise<ModelResult>;
/** Rechecks a medial surface, a .vtp, against its scan by other code. */
export function verify(
  scan: Scan,
  model: Uint8Array | NamedFile,
  options?: VerifyOptions,
  running?: Running,
): Promise<Result & { agrees: boolean }>;

/** A scan to be shown in slices, a byte a voxel. */
export interface ShownScan {
  /** Voxels along i, j, k. */
  size: [number, number, number];
  /** Of a large scan every `step`-th voxel along each axis is there; else 1. */
  step: number;
  /** Centre of the first, LPS. */
  origin: [number, number, number];
  /** The way from one to the next along i, j and k. */
  axes: [number, number, number][];
  unit: 'mm' | 'vox';
  /** i fastest. */
  values: Uint8Array;
  /** Of labels: those of codes 1, 2, ..., which begin again after 255. Code 0 is the background. */
  labels?: number[];
  /** Of grey values, which are those of a scan with a threshold: the values that codes 0 and 255 stand for. */
  window?: [number, number];
}

/** Reads a scan as `info` does, with the words of its command line; null for a mesh. At most `most` voxels, else every
 *  second along each axis or fewer. */
export function voxels(
  args: string[],
  files: Iterable<[string, Uint8Array | ArrayBuffer | Blob]>,
  running?: { signal?: AbortSignal; most?: number },
): Promise<ShownScan | null>;

/** The arrays of a .vtp that VoxelCore wrote. */
export function readVtp(bytes: Uint8Array): Promise<Mesh>;

/** An option of the program: a row of the table behind --help. */
export interface Option {
  name: string;
  /** '-o,--output'; empty: an argument without a name */
  flags: string;
  kind: 'input' | 'inputs' | 'output' | 'text' | 'integer' | 'real' | 'choice' | 'flag';
  /** Stands for the value, with its unit; of a choice its words, separated by | */
  placeholder: string;
  default: string;
  required: boolean;
  commands: string[];
  description: string;
  group: string;
}

/** All commands and options. */
export function table(): Promise<{
  commands: { name: string; description: string; footer: string }[];
  options: Option[];
}>;

/** '--lambda=1vox' and '--force' of {lambda: '1vox', force: true}. */
export function argumentsOf(options?: Record<string, unknown>): string[];

/** Where the parts are, if not beside index.js: the WebAssembly, and how to start a worker with worker.js in it. */
export function configure(parts: {
  wasm?: string | URL | Uint8Array | ArrayBuffer | WebAssembly.Module;
  worker?: () => Worker;
}): void;
