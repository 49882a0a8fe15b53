/* System calls that need the system's headers: numbers of errors, signals and options, layouts of structures. The
   modules of this folder bind them. Functions that answer a question return 1 for yes, others 1 where they succeeded;
   errno says why not. */
#define _GNU_SOURCE
#define _FILE_OFFSET_BITS 64
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- errors ------------------------------------------------------------------------------------ */

/* The system's words for what went wrong last. */
const char *tiltpad_reason(void)
{
   return strerror(errno);
}

/* Whether that is a reason for which files cannot be written. */
int tiltpad_writing_refused(void)
{
   switch (errno) {
   case ENOENT: case EIO: case EACCES: case EFBIG: case ENOSPC: case EROFS: case EDQUOT:
      return 1;
   default:
      return 0;
   }
}

/* What is missing is no reason: a library looks for other files, too. */
void tiltpad_forget_missing(void)
{
   if (errno == ENOENT) errno = 0;
}

/* ---- files ------------------------------------------------------------------------------------- */

int tiltpad_is_regular(const char *path)
{
   struct stat status;
   return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

/* Writes the path without links, at most `size` characters with the last null character; 0 where nothing is there. */
int tiltpad_real_path(const char *path, char *resolved, size_t size)
{
   char *found = realpath(path, NULL);
   int fits = found && strlen(found) < size;
   if (fits) strcpy(resolved, found);
   free(found);
   return fits;
}

/* Tells one file from every other of its folder, also from one that gets its inode later: "inode:birth". Empty where
   nothing has the name, "-" for what is no ordinary file; a link is not followed. */
void tiltpad_identity(const char *path, char *identity, size_t size)
{
   struct statx found;
   *identity = 0;
   if (statx(AT_FDCWD, path, AT_SYMLINK_NOFOLLOW, STATX_TYPE | STATX_INO | STATX_BTIME, &found) != 0) {
      if (errno != ENOENT && errno != ENOTDIR) snprintf(identity, size, "-");
      return;
   }
   if (!(found.stx_mask & STATX_BTIME)) memset(&found.stx_btime, 0, sizeof found.stx_btime);
   if (S_ISREG(found.stx_mode))
      snprintf(identity, size, "%llu:%lld.%u", (unsigned long long)found.stx_ino, (long long)found.stx_btime.tv_sec,
               (unsigned)found.stx_btime.tv_nsec);
   else
      snprintf(identity, size, "-");
}

/* Exchanges the names of two files at once, where the file system can. */
int tiltpad_exchange(const char *one, const char *other)
{
   return renameat2(AT_FDCWD, one, AT_FDCWD, other, RENAME_EXCHANGE) == 0;
}

/* Makes an empty file; nothing may have its name. */
int tiltpad_create(const char *path)
{
   int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
   return file >= 0 && close(file) == 0;
}

/* Copies within the kernel into a file that is there, in place of what it contains. */
int tiltpad_copy(const char *old_path, const char *new_path)
{
   ssize_t copied = -1;
   int from = open(old_path, O_RDONLY | O_CLOEXEC), to;
   if (from < 0) return 0;
   to = open(new_path, O_WRONLY | O_TRUNC | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
   if (to >= 0) {
      do copied = sendfile(to, from, NULL, 1 << 30);
      while (copied > 0);
      if (close(to) != 0) copied = -1;
   }
   close(from);
   return copied == 0;
}

/* Writes a file (or folder: the names in it) to the disk itself. */
int tiltpad_sync(const char *path)
{
   int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC), result;
   if (file < 0) return 0;
   result = fsync(file);
   close(file);
   return result == 0;
}

/* Has the system begin to do so, without waiting for the end. */
void tiltpad_begin_sync(const char *path)
{
   int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
   if (file < 0) return;
   sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE);
   close(file);
}

/* ---- locks ------------------------------------------------------------------------------------- */

/* Whether it can be a lock file: an ordinary file with this name alone, or with none any more. */
static int can_be_lock(const struct stat *status)
{
   return S_ISREG(status->st_mode) && status->st_nlink <= 1;
}

/* Opens a lock file, or makes it; -1 where that is not possible, -2 where the name is another thing's. */
int tiltpad_open_lock(const char *path)
{
   struct stat status;
   int file;
   /* looked at first, as opening a device can do something */
   if (lstat(path, &status) == 0 && !can_be_lock(&status)) return -2;
   file = open(path, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
   if (file < 0) return errno == ELOOP ? -2 : -1;
   if (fstat(file, &status) == 0 && can_be_lock(&status)) return file;
   close(file);
   return -2;
}

/* 0: locked; 1: another process holds the lock; 2: locks are not known here. */
int tiltpad_try_lock(int file)
{
   if (lockf(file, F_TLOCK, 0) == 0) return 0;
   return errno == EAGAIN || errno == EACCES ? 1 : 2;
}

/* Whether the open file is the one of this name. */
int tiltpad_has_name(int file, const char *path)
{
   struct stat open_one, named;
   return fstat(file, &open_one) == 0 && lstat(path, &named) == 0 && open_one.st_ino == named.st_ino &&
          open_one.st_dev == named.st_dev;
}

/* Reads up to `size` bytes from the beginning of the file, and returns their number; negative after a failure. */
int tiltpad_read_start(int file, char *bytes, int size)
{
   return pread(file, bytes, size, 0);
}

/* Writes bytes over the beginning of the file. */
int tiltpad_write_start(int file, const char *bytes, int size)
{
   return pwrite(file, bytes, size, 0) == size;
}

/* ---- processes --------------------------------------------------------------------------------- */

/* Processors that this process may use. */
int tiltpad_processors(void)
{
   cpu_set_t set[64];
   memset(set, 0, sizeof set);
   if (sched_getaffinity(0, sizeof set, set) != 0) return 1;
   return CPU_COUNT_S(sizeof set, set);
}

/* Whether a process of this number runs on this machine. */
int tiltpad_is_alive(int process)
{
   return kill(process, 0) == 0 || errno != ESRCH;
}

/* Makes a folder; 2 where something of its name is there. */
int tiltpad_make_folder(const char *path)
{
   if (mkdir(path, 0777) == 0) return 1;
   return errno == EEXIST ? 2 : 0;
}

/* A name in a folder that is a number with .h5, but not one from 1 to `last` with this number of digits; empty where there is
   none. */
void tiltpad_other_number(const char *folder, int digits, long last, char *name, size_t size)
{
   DIR *names = opendir(folder);
   struct dirent *entry;
   *name = 0;
   while (names && (entry = readdir(names)) && !*name) {
      size_t length = strspn(entry->d_name, "0123456789");
      long number = strtol(entry->d_name, NULL, 10);
      if (length == 0 || strcmp(entry->d_name + length, ".h5") != 0) continue;
      if (length != (size_t)digits || number < 1 || number > last) snprintf(name, size, "%s", entry->d_name);
   }
   if (names) closedir(names);
}

/* SIGTERM will come to this process when its parent ends; 0 where it is an orphan already. */
int tiltpad_end_with_parent(int parent)
{
   prctl(PR_SET_PDEATHSIG, SIGTERM);
   return getppid() == parent;
}

/* Whether there is something to read from a pipe, after at most this number of milliseconds. */
int tiltpad_can_read(int pipe, int milliseconds)
{
   struct pollfd list = {pipe, POLLIN, 0};
   return poll(&list, 1, milliseconds) == 1;
}

/* 0: the child runs; 1: it ended with exit status *code; 2: it was ended by signal *code. */
int tiltpad_child_state(int process, int wait, int *code)
{
   int status, found;
   do found = waitpid(process, &status, wait ? 0 : WNOHANG);
   while (found == -1 && wait && errno == EINTR);
   if (found != process) return 0;
   *code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
   return WIFSIGNALED(status) ? 2 : 1;
}

void tiltpad_stop(int process)
{
   kill(process, SIGTERM);
}

/* From now on this process prints nothing, and ends after this number of seconds of time, or of the processor's; it gets this
   number of megabytes of memory more than it has. */
void tiltpad_limit_child(int seconds, int work, int room)
{
   struct rlimit time = {work, work}, memory, core = {0, 0};
   unsigned long pages = 0;
   FILE *own = fopen("/proc/self/statm", "r");
   int nothing = open("/dev/null", O_WRONLY);
   if (nothing >= 0) {
      dup2(nothing, STDOUT_FILENO);
      dup2(nothing, STDERR_FILENO);
   }
   alarm(seconds);
   setrlimit(RLIMIT_CORE, &core);
   setrlimit(RLIMIT_CPU, &time);
   if (!own) return;
   if (fscanf(own, "%lu", &pages) == 1) {
      memory.rlim_cur = memory.rlim_max = pages * (rlim_t)sysconf(_SC_PAGESIZE) + ((rlim_t)room << 20);
      setrlimit(RLIMIT_AS, &memory);
   }
   fclose(own);
}

/* ---- signals ----------------------------------------------------------------------------------- */

static volatile sig_atomic_t received;

static void note(int number)
{
   received = number;
}

/* Signals that ask the program to stop are noted from now on and end nothing by themselves; nor does a reader of what
   is printed end it by going away. */
void tiltpad_catch_signals(void)
{
   signal(SIGINT, note);
   signal(SIGUSR1, note);
   signal(SIGTERM, note);
   signal(SIGXCPU, note);
   signal(SIGPIPE, SIG_IGN);
   /* whoever starts the program may ignore it; children could not be waited for then */
   signal(SIGCHLD, SIG_DFL);
}

/* A file that grows past the limit of the shell then fails in writing, instead of ending the program. */
void tiltpad_ignore_file_limit(void)
{
   signal(SIGXFSZ, SIG_IGN);
}

/* The signal that came last; 0 for none. */
int tiltpad_received_signal(void)
{
   return received;
}
