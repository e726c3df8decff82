// A library to preload, in which one call fails: the FAULT_AT-th of the kind FAULT_CALL that concerns a file under
// FAULT_PATHS, or asks for FAULT_SIZE bytes of memory or more. Calls are counted over a whole tree of processes.
//
//   FAULT_CALL     open read write close rename sync mkdir map memory; exit: a read or write, in which the program
//                  is ended with FAULT_ERROR, as libraries do; clock: from that call on, the time of day is FAULT_ERROR
//                  seconds off, and again as much with each call
//   FAULT_AT       which call, from 1; 0 only counts
//   FAULT_ERROR    errno it gives; 0 with read and write: half of what was asked for is done
//   FAULT_PATHS    prefix of absolute paths
//   FAULT_SIZE     bytes, for memory and map
//   FAULT_COUNTER  file of two 64-bit numbers, to which all processes count: calls, and failures
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

extern void * __libc_malloc(size_t);
extern void * __libc_calloc(size_t, size_t);
extern void *
              __libc_realloc(void *, size_t);
extern void * __libc_memalign(size_t, size_t);

static const char *        s_Call;
static const char *        s_Paths;
static long                s_At;
static int                 s_Error;
static size_t              s_Size;
static volatile uint64_t * s_Counter;

__attribute__((constructor)) static void
Begin(void)
{
  const char * const counter = getenv("FAULT_COUNTER");
  const char * const at = getenv("FAULT_AT");
  const char * const error = getenv("FAULT_ERROR");
  const char * const size = getenv("FAULT_SIZE");
  const char * const call = getenv("FAULT_CALL");
  s_Paths = getenv("FAULT_PATHS");
  s_At = at ? atol(at) : 0;
  s_Error = error ? atoi(error) : EIO;
  s_Size = size ? (size_t)atol(size) : (size_t)-1;
  const int file = counter ? (int)syscall(SYS_openat, AT_FDCWD, counter, O_RDWR | O_CLOEXEC) : -1;
  if (file >= 0)
  {
    void * const memory = (void *)syscall(SYS_mmap, NULL, 16, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    syscall(SYS_close, file);
    s_Counter = memory == MAP_FAILED ? NULL : (volatile uint64_t *)memory;
  }
  s_Call = s_Counter ? call : NULL;
}

/** Whether this call is the one; errno is then set. */
static int
Fails(const char * call)
{
  if (s_Call && strcmp(s_Call, "exit") == 0)
  {
    const int isMeant = strcmp(call, "read") == 0 || strcmp(call, "write") == 0;
    if (isMeant && __atomic_add_fetch(&s_Counter[0], 1, __ATOMIC_SEQ_CST) == (uint64_t)s_At)
    {
      __atomic_add_fetch(&s_Counter[1], 1, __ATOMIC_SEQ_CST);
      exit(s_Error);
    }
    return 0;
  }
  if (!s_Call || strcmp(call, s_Call) != 0)
  {
    return 0;
  }
  if (__atomic_add_fetch(&s_Counter[0], 1, __ATOMIC_SEQ_CST) != (uint64_t)s_At)
  {
    return 0;
  }
  __atomic_add_fetch(&s_Counter[1], 1, __ATOMIC_SEQ_CST);
  errno = s_Error;
  return 1;
}

static int
IsMeant(const char * path)
{
  return s_Call && s_Paths && path && strncmp(path, s_Paths, strlen(s_Paths)) == 0;
}

static int
IsMeantFile(int file)
{
  if (!s_Call || !s_Paths || file < 0)
  {
    return 0;
  }
  char      link[64];
  char      path[4096];
  const int before = errno;
  snprintf(link, sizeof(link), "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof(path) - 1);
  errno = before;
  if (length <= 0)
  {
    return 0;
  }
  path[length] = '\0';
  return IsMeant(path);
}

#define NEXT(name)                                     \
  static __typeof__(&name) next;                       \
  if (!next)                                           \
  {                                                    \
    next = (__typeof__(&name))dlsym(RTLD_NEXT, #name); \
  }

#define OPEN(name)                                                        \
  int name(const char * path, int flags, ...)                             \
  {                                                                       \
    NEXT(name)                                                            \
    va_list rest;                                                         \
    va_start(rest, flags);                                                \
    const mode_t mode = va_arg(rest, mode_t);                             \
    va_end(rest);                                                         \
    return IsMeant(path) && Fails("open") ? -1 : next(path, flags, mode); \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                              \
  int name(int folder, const char * path, int flags, ...)                         \
  {                                                                               \
    NEXT(name)                                                                    \
    va_list rest;                                                                 \
    va_start(rest, flags);                                                        \
    const mode_t mode = va_arg(rest, mode_t);                                     \
    va_end(rest);                                                                 \
    return IsMeant(path) && Fails("open") ? -1 : next(folder, path, flags, mode); \
  }
OPENAT(openat)
OPENAT(openat64)

#define FOPEN(name)                                                  \
  FILE * name(const char * path, const char * mode)                  \
  {                                                                  \
    NEXT(name)                                                       \
    return IsMeant(path) && Fails("open") ? NULL : next(path, mode); \
  }
FOPEN(fopen)
FOPEN(fopen64)

/** Half of what was asked for, at least one byte, where it is not to fail. */
static size_t
Half(size_t size)
{
  return size > 1 ? size / 2 : size;
}

/** Reads and writes: the one that is meant fails, or does half. */
#define TRANSFER(name, call, parameters, whole, half) \
  ssize_t name parameters                             \
  {                                                   \
    NEXT(name)                                        \
    if (IsMeantFile(file) && Fails(call))             \
    {                                                 \
      return s_Error ? -1 : next half;                \
    }                                                 \
    return next whole;                                \
  }
// clang-format off
TRANSFER(write, "write", (int file, const void * from, size_t size), (file, from, size), (file, from, Half(size)))
TRANSFER(writev, "write", (int file, const struct iovec * parts, int count), (file, parts, count),
         (file, parts, count > 1 ? 1 : count))
TRANSFER(pwrite, "write", (int file, const void * from, size_t size, off_t at), (file, from, size, at),
         (file, from, Half(size), at))
TRANSFER(pwrite64, "write", (int file, const void * from, size_t size, off64_t at), (file, from, size, at),
         (file, from, Half(size), at))
TRANSFER(read, "read", (int file, void * to, size_t size), (file, to, size), (file, to, Half(size)))
TRANSFER(pread, "read", (int file, void * to, size_t size, off_t at), (file, to, size, at), (file, to, Half(size), at))
TRANSFER(pread64, "read", (int file, void * to, size_t size, off64_t at), (file, to, size, at),
         (file, to, Half(size), at))
// clang-format on

// What the C library buffers reaches the system from within itself, where no other library is asked.

/** What a buffer that cannot be written, or read, leaves behind in its stream. */
static void
MarkBad(FILE * stream)
{
  stream->_flags |= 0x20; // _IO_ERR_SEEN
}

#define ITEMS(name, call, pointer)                                                             \
  size_t name(pointer items, size_t size, size_t count, FILE * stream)                         \
  {                                                                                            \
    NEXT(name)                                                                                 \
    if (size != 0 && count != 0 && s_Error != 0 && IsMeantFile(fileno(stream)) && Fails(call)) \
    {                                                                                          \
      MarkBad(stream);                                                                         \
      return 0;                                                                                \
    }                                                                                          \
    return next(items, size, count, stream);                                                   \
  }
ITEMS(fwrite, "write", const void *)
ITEMS(fread, "read", void *)

int
fflush(FILE * stream)
{
  NEXT(fflush)
  if (stream && s_Error != 0 && IsMeantFile(fileno(stream)) && Fails("write"))
  {
    MarkBad(stream);
    return EOF;
  }
  return next(stream);
}

int
fclose(FILE * stream)
{
  NEXT(fclose)
  if (IsMeantFile(fileno(stream)) && Fails("close"))
  {
    next(stream);
    errno = s_Error;
    return EOF;
  }
  return next(stream);
}

int
close(int file)
{
  NEXT(close)
  if (IsMeantFile(file) && Fails("close"))
  {
    next(file);
    errno = s_Error;
    return -1;
  }
  return next(file);
}

int
rename(const char * from, const char * to)
{
  NEXT(rename)
  return IsMeant(to) && Fails("rename") ? -1 : next(from, to);
}

int
mkdir(const char * path, mode_t mode)
{
  NEXT(mkdir)
  return IsMeant(path) && Fails("mkdir") ? -1 : next(path, mode);
}

int
fsync(int file)
{
  NEXT(fsync)
  return IsMeantFile(file) && Fails("sync") ? -1 : next(file);
}

int
fdatasync(int file)
{
  NEXT(fdatasync)
  return IsMeantFile(file) && Fails("sync") ? -1 : next(file);
}

#define MAP(name, type)                                                                           \
  void * name(void * where, size_t size, int protection, int flags, int file, type at)            \
  {                                                                                               \
    NEXT(name)                                                                                    \
    const int isMeant = file >= 0 ? IsMeantFile(file) : size >= s_Size;                           \
    return isMeant && Fails("map") ? MAP_FAILED : next(where, size, protection, flags, file, at); \
  }
MAP(mmap, off_t)
MAP(mmap64, off64_t)

void *
malloc(size_t size)
{
  return size >= s_Size && Fails("memory") ? NULL : __libc_malloc(size);
}

void *
calloc(size_t count, size_t size)
{
  const int isLarge = size != 0 && count >= s_Size / size && s_Size != (size_t)-1;
  return isLarge && Fails("memory") ? NULL : __libc_calloc(count, size);
}

void *
realloc(void * old, size_t size)
{
  return size >= s_Size && Fails("memory") ? NULL : __libc_realloc(old, size);
}

void *
aligned_alloc(size_t alignment, size_t size)
{
  return size >= s_Size && Fails("memory") ? NULL : __libc_memalign(alignment, size);
}

int
posix_memalign(void ** to, size_t alignment, size_t size)
{
  if (size >= s_Size && Fails("memory"))
  {
    return ENOMEM;
  }
  void * const memory = __libc_memalign(alignment, size);
  if (!memory)
  {
    return ENOMEM;
  }
  *to = memory;
  return 0;
}

/** How far off the time of day is by now, in seconds. */
static long
Jump(void)
{
  if (!s_Call || strcmp("clock", s_Call) != 0 || s_At == 0)
  {
    return 0;
  }
  const long calls = (long)__atomic_add_fetch(&s_Counter[0], 1, __ATOMIC_SEQ_CST);
  if (calls < s_At)
  {
    return 0;
  }
  __atomic_store_n(&s_Counter[1], 1, __ATOMIC_SEQ_CST);
  return (calls - s_At + 1) * (long)s_Error;
}

int
clock_gettime(clockid_t clock, struct timespec * now)
{
  const int result = (int)syscall(SYS_clock_gettime, clock, now);
  if (result == 0 && clock == CLOCK_REALTIME)
  {
    now->tv_sec += Jump();
  }
  return result;
}

int
gettimeofday(struct timeval * restrict now, void * restrict zone)
{
  const int result = (int)syscall(SYS_gettimeofday, now, zone);
  if (result == 0)
  {
    now->tv_sec += Jump();
  }
  return result;
}

time_t
time(time_t * to)
{
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (to)
  {
    *to = now.tv_sec;
  }
  return now.tv_sec;
}
