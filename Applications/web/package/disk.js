// Gives the program Node's files in place of files in memory: same names, same working folder, same errors.

import fs from 'node:fs';
import path from 'node:path';
import tty from 'node:tty';

// The numbers that errors have in WebAssembly.
const errors = {
  EACCES: 2, EAGAIN: 6, EBADF: 8, EBUSY: 10, EDQUOT: 19, EEXIST: 20, EFBIG: 22, EINVAL: 28, EIO: 29, EISDIR: 31,
  ELOOP: 32, EMFILE: 33, EMLINK: 34, ENAMETOOLONG: 37, ENFILE: 41, ENODEV: 43, ENOENT: 44, ENOMEM: 48, ENOSPC: 51,
  ENOTDIR: 54, ENOTEMPTY: 55, ENOTSUP: 58, ENXIO: 60, EOVERFLOW: 61, EPERM: 63, EPIPE: 64, EROFS: 69, ESPIPE: 70,
  ESTALE: 72, ETXTBSY: 74, EXDEV: 75,
};

// What open() is asked for, as the program's C library has it, and as this system has it.
const flagNames = {
  O_WRONLY: 1, O_RDWR: 2, O_CREAT: 64, O_EXCL: 128, O_TRUNC: 512, O_APPEND: 1024, O_DIRECTORY: 65536,
  O_NOFOLLOW: 131072,
};

const flagsHere = (flags) => Object.entries(flagNames)
  .reduce((sum, [name, bit]) => sum | (flags & bit ? fs.constants[name] ?? 0 : 0), 0);

/** @param onTemporary is told of each file that must be new */
export function useDisk({ FS }, onTemporary) {
  const refuse = (code) => {
    throw new FS.ErrnoError(errors[code] ?? errors.EIO);
  };
  const nodeOf = (name) => {
    const status = fs.lstatSync(name);
    return { id: status.ino, mode: status.mode, path: name };
  };
  const isSeekable = (descriptor) => {
    const status = fs.fstatSync(descriptor);
    return status.isFile() || status.isBlockDevice();
  };
  const streamOf = (descriptor, name, flags, node, fd) => {
    FS.streams[fd] = {
      fd, descriptor, path: name, flags, node, position: 0,
      seekable: descriptor > 2 && isSeekable(descriptor), // others write to the standard ones, too
      tty: tty.isatty(descriptor),
    };
    return FS.streams[fd];
  };
  const calls = {
    cwd: () => process.cwd(),
    chdir: () => refuse('ENOTSUP'),
    lookupPath(name, options) {
      const found = options?.parent ? path.dirname(name) : name;
      return { path: found, node: nodeOf(options?.follow ? fs.realpathSync(found) : found) };
    },
    lookupNode: (parent, name) => nodeOf(path.join(parent.path, name)),
    nodePermissions(node, asked) {
      const mode = (asked.includes('r') ? 4 : 0) | (asked.includes('w') ? 2 : 0) | (asked.includes('x') ? 1 : 0);
      try {
        fs.accessSync(node.path, mode);
        return 0;
      } catch {
        return errors.EACCES;
      }
    },
    getPath: (node) => node.path,
    stat: (name) => fs.statSync(name),
    lstat: (name) => fs.lstatSync(name),
    readdir: (name) => ['.', '..', ...fs.readdirSync(name)],
    mkdir: (name, mode) => fs.mkdirSync(name, mode),
    rmdir: (name) => fs.rmdirSync(name),
    unlink: (name) => fs.unlinkSync(name),
    rename: (from, to) => fs.renameSync(from, to),
    symlink: (to, name) => fs.symlinkSync(to, name),
    readlink: (name) => fs.readlinkSync(name),
    chmod: (name, mode) => fs.chmodSync(name, mode),
    truncate: (name, size) => fs.truncateSync(name, size),
    ftruncate: (fd, size) => fs.ftruncateSync(FS.streams[fd].descriptor, size),
    utime: (name, read, written) => fs.utimesSync(name, read / 1000, written / 1000),
    open(name, flags, mode) {
      const descriptor = fs.openSync(name, flagsHere(flags), mode);
      if (flags & flagNames.O_EXCL) onTemporary?.(path.resolve(name));
      return streamOf(descriptor, name, flags, { ...nodeOf(name), mode: fs.fstatSync(descriptor).mode }, FS.nextfd());
    },
    close(stream) {
      if (stream.descriptor > 2) fs.closeSync(stream.descriptor); // the standard ones are the process's own
      FS.closeStream(stream.fd);
    },
    llseek(stream, offset, whence) {
      if (!stream.seekable && !FS.isDir(stream.node.mode)) refuse('ESPIPE');
      const from = whence === 1 ? stream.position : whence === 2 ? fs.fstatSync(stream.descriptor).size : 0;
      if (from + offset < 0) refuse('EINVAL');
      stream.position = from + offset;
      return stream.position;
    },
    read(stream, heap, at, length, position) {
      const from = position ?? (stream.seekable ? stream.position : null);
      const done = fs.readSync(stream.descriptor, new Uint8Array(heap.buffer, at, length), 0, length, from);
      if (position === undefined) stream.position += done;
      return done;
    },
    write(stream, heap, at, length, position) {
      const isAtEnd = !stream.seekable || (stream.flags & flagNames.O_APPEND) !== 0;
      const to = position ?? (isAtEnd ? null : stream.position);
      for (;;) {
        try {
          const done = fs.writeSync(stream.descriptor, new Uint8Array(heap.buffer, at, length), 0, length, to);
          if (position === undefined) stream.position += done;
          return done;
        } catch (error) {
          if (error.code !== 'EAGAIN') throw error; // a pipe that is full for now
        }
      }
    },
  };
  for (const [name, call] of Object.entries(calls)) {
    FS[name] = (...words) => {
      try {
        return call(...words);
      } catch (error) {
        if (error.code === undefined) throw error;
        return refuse(error.code);
      }
    };
  }
  for (const fd of [0, 1, 2]) {
    try {
      streamOf(fd, '', fd === 0 ? 0 : flagNames.O_WRONLY, { mode: 0 }, fd);
    } catch {
      FS.streams[fd] = null; // closed from the start
    }
  }
}
