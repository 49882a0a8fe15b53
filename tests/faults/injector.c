/* Stands before the system's own functions (LD_PRELOAD), counts the calls of each kind, and lets one fail, or kills.

   FAULT_COUNTS   a file of zeros, as many bytes as struct counts has: the calls of all processes together
   FAULT_FOLDER   calls for files count where these are in this folder, and all from the first one on that is opened;
                  without it all calls count, for whichever file
   FAULT          "KIND CALL ACTION MODE", or nothing: the calls are counted only. ACTION: a number of an error,
                  kill (the process), killall (its group), short (half of it is written), torn (the same, and then
                  killed). MODE: once, or always (from this call on) */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

/* ---- what is counted and done ------------------------------------------------------------------ */

enum kind { OPEN, READ, WRITE, TRUNCATE, SYNC, CLOSE, RENAME, DELETE, STAT, LOCK, FORK, MEMORY, KINDS };
static const char *const names[KINDS] = {"open", "read", "write", "truncate", "sync", "close",
                                         "rename", "delete", "stat", "lock", "fork", "memory"};

static struct counts {
   long calls[KINDS], begun, faults;
} *counts;

static char folder[4096], action[20];
static enum kind faulty = KINDS;
static long first;
static bool always;
/* files that are open, by their descriptors */
static bool in_folder[4096];

__attribute__((constructor)) static void begin(void)
{
   char kind[20], mode[20];
   const char *path = getenv("FAULT_COUNTS"), *fault = getenv("FAULT"), *where = getenv("FAULT_FOLDER");
   void *shared;
   int file;
   if (!path) return;
   snprintf(folder, sizeof folder, "%s/", where ? where : "");
   if (fault && sscanf(fault, "%19s %ld %19s %19s", kind, &first, action, mode) == 4) {
      for (faulty = 0; faulty < KINDS && strcmp(kind, names[faulty]) != 0; faulty++);
      always = strcmp(mode, "always") == 0;
   }
   file = open(path, O_RDWR | O_CLOEXEC);
   shared = mmap(NULL, sizeof *counts, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
   close(file);
   if (shared == MAP_FAILED) return;
   counts = shared;
   if (!where) counts->begun = 1;
}

/* Counts a call, and gives whether it has the fault; what kills does not return. */
static bool fails(enum kind kind)
{
   long call;
   if (!counts || !counts->begun) return false;
   call = __atomic_add_fetch(&counts->calls[kind], 1, __ATOMIC_SEQ_CST);
   if (kind != faulty || call < first || (call > first && !always)) return false;
   __atomic_add_fetch(&counts->faults, 1, __ATOMIC_SEQ_CST);
   if (strcmp(action, "killall") == 0) kill(0, SIGKILL);
   if (strcmp(action, "kill") == 0) kill(getpid(), SIGKILL);
   errno = atoi(action);
   return true;
}

/* Whether a path is in the folder: where the process works, relative paths are. */
static bool ours(const char *path)
{
   return path && counts && (*path != '/' || strncmp(path, folder, strlen(folder)) == 0);
}

static bool known(int file)
{
   return file >= 0 && file < (int)sizeof in_folder && in_folder[file];
}

/* Notes an opened file. */
static int opened(int file, bool is_ours)
{
   if (file >= 0 && file < (int)sizeof in_folder) in_folder[file] = is_ours;
   return file;
}

/* ---- the functions ----------------------------------------------------------------------------- */

#define NEXT(name) ((__typeof__(name) *)dlsym(RTLD_NEXT, #name))
/* A function for a file of a path, or an open one: what it is declared and called with. */
#define OF_PATH(kind, type, failure, name, path, declared, given) \
type name declared { return ours(path) && fails(kind) ? failure : NEXT(name) given; }
#define OF_FILE(kind, type, name, file, declared, given) \
type name declared { return known(file) && fails(kind) ? -1 : NEXT(name) given; }

#define OPENS(name, declared, given) \
int name declared \
{ \
   va_list more; \
   mode_t mode; \
   bool is_ours = ours(path); \
   if (is_ours) counts->begun = 1; \
   if (is_ours && fails(OPEN)) return -1; \
   va_start(more, flags); \
   mode = flags & O_CREAT ? va_arg(more, mode_t) : 0; \
   va_end(more); \
   return opened(NEXT(name) given, is_ours); \
}
OPENS(open, (const char *path, int flags, ...), (path, flags, mode))
OPENS(open64, (const char *path, int flags, ...), (path, flags, mode))
OPENS(openat, (int at, const char *path, int flags, ...), (at, path, flags, mode))
OPENS(openat64, (int at, const char *path, int flags, ...), (at, path, flags, mode))

#define READS(name, declared, given) OF_FILE(READ, ssize_t, name, file, declared, given)
READS(read, (int file, void *bytes, size_t size), (file, bytes, size))
READS(pread, (int file, void *bytes, size_t size, off_t place), (file, bytes, size, place))
READS(pread64, (int file, void *bytes, size_t size, off64_t place), (file, bytes, size, place))

/* Half of it may be written. */
#define WRITES(name, file, declared, whole, half) \
ssize_t name declared \
{ \
   ssize_t written; \
   if (!known(file) || !fails(WRITE)) return NEXT(name) whole; \
   if (errno != 0) return -1; \
   written = NEXT(name) half; \
   if (strcmp(action, "torn") == 0) kill(0, SIGKILL); \
   return written; \
}
#define HALF ((size + 1) / 2)
WRITES(write, file, (int file, const void *bytes, size_t size), (file, bytes, size), (file, bytes, HALF))
WRITES(pwrite, file, (int file, const void *bytes, size_t size, off_t place), (file, bytes, size, place),
       (file, bytes, HALF, place))
WRITES(pwrite64, file, (int file, const void *bytes, size_t size, off64_t place), (file, bytes, size, place),
       (file, bytes, HALF, place))
WRITES(sendfile, to, (int to, int from, off_t *place, size_t size), (to, from, place, size), (to, from, place, 1000))
WRITES(sendfile64, to, (int to, int from, off64_t *place, size_t size), (to, from, place, size),
       (to, from, place, 1000))

OF_FILE(TRUNCATE, int, ftruncate, file, (int file, off_t size), (file, size))
OF_FILE(TRUNCATE, int, ftruncate64, file, (int file, off64_t size), (file, size))
OF_FILE(SYNC, int, fsync, file, (int file), (file))
OF_FILE(SYNC, int, fdatasync, file, (int file), (file))
OF_FILE(LOCK, int, flock, file, (int file, int how), (file, how))
OF_FILE(LOCK, int, lockf, file, (int file, int how, off_t size), (file, how, size))
OF_FILE(LOCK, int, lockf64, file, (int file, int how, off64_t size), (file, how, size))
OF_FILE(STAT, int, fstat, file, (int file, struct stat *found), (file, found))
OF_FILE(STAT, int, fstat64, file, (int file, struct stat64 *found), (file, found))

#define OF_NAME(kind, name, declared, given) OF_PATH(kind, int, -1, name, path, declared, given)
OF_NAME(STAT, stat, (const char *restrict path, struct stat *restrict found), (path, found))
OF_NAME(STAT, stat64, (const char *restrict path, struct stat64 *restrict found), (path, found))
OF_NAME(STAT, lstat, (const char *restrict path, struct stat *restrict found), (path, found))
OF_NAME(STAT, lstat64, (const char *restrict path, struct stat64 *restrict found), (path, found))
OF_NAME(STAT, statx, (int at, const char *restrict path, int flags, unsigned mask, struct statx *restrict found),
        (at, path, flags, mask, found))
OF_NAME(RENAME, rename, (const char *path, const char *other), (path, other))
OF_NAME(RENAME, renameat2, (int at, const char *path, int to, const char *other, unsigned flags),
        (at, path, to, other, flags))
OF_NAME(DELETE, unlink, (const char *path), (path))
OF_NAME(DELETE, unlinkat, (int at, const char *path, int flags), (at, path, flags))
OF_NAME(DELETE, rmdir, (const char *path), (path))
OF_NAME(OPEN, mkdir, (const char *path, mode_t mode), (path, mode))

/* It is closed nevertheless, as the system does. */
int close(int file)
{
   bool failed = known(file) && fails(CLOSE);
   int reason = errno, result;
   opened(file, false);
   result = NEXT(close)(file);
   if (!failed) return result;
   errno = reason;
   return -1;
}

pid_t fork(void)
{
   return fails(FORK) ? -1 : NEXT(fork)();
}

/* The C library's own, as what looks for the next function asks for memory. A request for no bytes, as the compiler makes
   for an empty array, needs none and does not fail. */
#define MEMORY_OF(name, declared, given, bytes) \
void *__libc_##name declared; \
void *name declared { return bytes && fails(MEMORY) ? NULL : __libc_##name given; }
MEMORY_OF(malloc, (size_t size), (size), size)
MEMORY_OF(calloc, (size_t count, size_t size), (count, size), size)
MEMORY_OF(realloc, (void *memory, size_t size), (memory, size), size)
MEMORY_OF(memalign, (size_t alignment, size_t size), (alignment, size), size)
