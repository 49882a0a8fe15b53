/* System calls that need the system's headers: numbers of errors, signals and options, layouts of structures. The
   modules of this folder bind them. Functions that answer a question return 1 for yes, others 1 where they succeeded;
   errno says why not. */
#define _GNU_SOURCE
#define _FILE_OFFSET_BITS 64
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
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

/* Copies within the kernel; a file of the new name is replaced. */
int tiltpad_copy(const char *old_path, const char *new_path)
{
   ssize_t copied = -1;
   int from = open(old_path, O_RDONLY), to;
   if (from < 0) return 0;
   to = open(new_path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
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
   int file = open(path, O_RDONLY), result;
   if (file < 0) return 0;
   result = fsync(file);
   close(file);
   return result == 0;
}

/* Has the system begin to do so, without waiting for the end. */
void tiltpad_begin_sync(const char *path)
{
   int file = open(path, O_RDONLY);
   if (file < 0) return;
   sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE);
   close(file);
}

/* ---- locks ------------------------------------------------------------------------------------- */

/* Opens a lock file, or makes it; negative where that is not possible. */
int tiltpad_open_lock(const char *path)
{
   return open(path, O_RDWR | O_CREAT, 0666);
}

/* 0: locked; 1: another process holds the lock; 2: locks are not known here. */
int tiltpad_try_lock(int file)
{
   if (lockf(file, F_TLOCK, 0) == 0) return 0;
   return errno == EAGAIN || errno == EACCES ? 1 : 2;
}

/* Whether the open file still has a name. */
int tiltpad_has_name(int file)
{
   struct stat status;
   return fstat(file, &status) != 0 || status.st_nlink > 0;
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

/* Makes a folder unless something of its name is there. */
int tiltpad_make_folder(const char *path)
{
   return mkdir(path, 0777) == 0 || errno == EEXIST;
}

/* SIGTERM will come to this process when its parent ends; 0 where it is an orphan already. */
int tiltpad_end_with_parent(int parent)
{
   prctl(PR_SET_PDEATHSIG, SIGTERM);
   return getppid() == parent;
}

/* Whether there is something to read from a pipe, after so many milliseconds at most. */
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

/* From now on this process prints nothing, and ends after so many seconds. */
void tiltpad_limit_child(int seconds)
{
   int nothing = open("/dev/null", O_WRONLY);
   if (nothing >= 0) {
      dup2(nothing, STDOUT_FILENO);
      dup2(nothing, STDERR_FILENO);
   }
   alarm(seconds);
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
   signal(SIGPIPE, SIG_IGN);
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
