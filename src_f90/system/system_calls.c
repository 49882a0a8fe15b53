/* System calls that need the system's headers: numbers of errors, signals and options, layouts of structures. The
   modules of this folder bind them and say what they do. Logical functions are true for yes, or where they succeeded;
   errno says why not. Texts that they return last until the next call. */
#define _GNU_SOURCE
#define _FILE_OFFSET_BITS 64
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* A text as Fortran gives it: CFI_cdesc_t, of which Fortran 2018 prescribes these members, the first two. */
typedef struct {
   char *start;
   size_t length;
} text_t;

/* Declares `name`, the text that ends with C's null character. */
#define C_STRING(name, text)                   \
   char name[(text)->length + 1];              \
   memcpy(name, (text)->start, (text)->length); \
   name[(text)->length] = 0

/* ---- errors ------------------------------------------------------------------------------------ */

/* The system's words for what went wrong last. */
const char *tiltpad_reason(void)
{
   return strerror(errno);
}

/* Whether that is a reason for which files cannot be written. */
bool tiltpad_writing_refused(void)
{
   switch (errno) {
   case ENOENT: case EIO: case EACCES: case EFBIG: case ENOSPC: case EROFS: case EDQUOT:
      return true;
   default:
      return false;
   }
}

/* What is missing is no reason: a library looks for other files, too. */
void tiltpad_forget_missing(void)
{
   if (errno == ENOENT) errno = 0;
}

/* ---- files ------------------------------------------------------------------------------------- */

bool tiltpad_rename(const text_t *old_path, const text_t *new_path)
{
   C_STRING(from, old_path);
   C_STRING(to, new_path);
   return rename(from, to) == 0;
}

void tiltpad_delete(const text_t *path)
{
   C_STRING(name, path);
   unlink(name);
}

/* What the system does not tell for another reason than the name is left to opening it. */
bool tiltpad_is_regular(const text_t *path)
{
   struct stat status;
   C_STRING(name, path);
   if (stat(name, &status) == 0) return S_ISREG(status.st_mode);
   return errno != ENOENT && errno != ENOTDIR && errno != ELOOP && errno != ENAMETOOLONG && errno != EACCES;
}

/* The path without links; where nothing is there, that at which the links end, at most 40 of them. */
const char *tiltpad_real_path(const text_t *path)
{
   static char found[2 * PATH_MAX];
   char next[PATH_MAX], resolved[PATH_MAX];
   snprintf(found, sizeof found, "%.*s", (int)path->length, path->start);
   for (int links = 0; links < 40; links++) {
      ssize_t length;
      char *name = strrchr(found, '/');
      if (realpath(found, resolved)) return strcpy(found, resolved);
      if ((length = readlink(found, next, sizeof next - 1)) < 1) break;
      next[length] = 0;
      /* a relative link begins in the folder that it is in */
      strcpy(*next == '/' || !name ? found : name + 1, next);
      if (strlen(found) >= PATH_MAX) break;
   }
   return found;
}

/* What the system says of a file that tells it from others; false unless it is not allowed to say. */
static bool is_refused(const char *name, struct statx *found)
{
   const unsigned wanted = STATX_TYPE | STATX_INO | STATX_BTIME;
   return statx(AT_FDCWD, name, AT_SYMLINK_NOFOLLOW, wanted, found) != 0 && errno == EPERM;
}

/* Tells one file from every other of its folder, also from one that gets its inode later: "inode:birth". Empty where
   nothing has the name, "-" for what is no ordinary file, "?" where the system does not say; a link is not followed. */
const char *tiltpad_identity(const text_t *path)
{
   static char identity[60];
   static bool no_statx;
   struct statx found = {0};
   struct stat status;
   C_STRING(name, path);
   /* a container that is older than statx refuses it, and not only once */
   no_statx = no_statx || (is_refused(name, &found) && is_refused(name, &found));
   if (no_statx && lstat(name, &status) == 0) {
      found.stx_mode = status.st_mode;
      found.stx_ino = status.st_ino;
   }
   if (!found.stx_mode) return errno == ENOENT || errno == ENOTDIR ? "" : "?";
   if (!S_ISREG(found.stx_mode)) return "-";
   if (!(found.stx_mask & STATX_BTIME)) memset(&found.stx_btime, 0, sizeof found.stx_btime);
   snprintf(identity, sizeof identity, "%llu:%lld.%u", (unsigned long long)found.stx_ino,
            (long long)found.stx_btime.tv_sec, (unsigned)found.stx_btime.tv_nsec);
   return identity;
}

bool tiltpad_exchange(const text_t *one_path, const text_t *other_path)
{
   C_STRING(one, one_path);
   C_STRING(other, other_path);
   return renameat2(AT_FDCWD, one, AT_FDCWD, other, RENAME_EXCHANGE) == 0;
}

bool tiltpad_create(const text_t *path)
{
   C_STRING(name, path);
   int file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666), reason;
   if (file < 0) return false;
   if (close(file) == 0) return true;
   reason = errno;
   unlink(name);
   errno = reason;
   return false;
}

/* Gives a file the permissions of another, where that is there. */
void tiltpad_take_mode(const text_t *from_path, const text_t *path)
{
   struct stat status;
   C_STRING(from, from_path);
   C_STRING(name, path);
   if (stat(from, &status) == 0) chmod(name, status.st_mode & 0777);
}

/* Whether this user may write a file that is there. */
bool tiltpad_is_writable(const text_t *path)
{
   C_STRING(name, path);
   return access(name, W_OK) == 0;
}

/* Whether the system lets an ordinary file be read. */
bool tiltpad_is_readable(const text_t *path)
{
   C_STRING(name, path);
   int file = open(name, O_RDONLY | O_CLOEXEC);
   if (file >= 0) close(file);
   return file >= 0;
}

/* Copies within the kernel into a file that is there, in place of what it contains. */
bool tiltpad_copy(const text_t *old_path, const text_t *new_path)
{
   ssize_t copied = -1;
   C_STRING(old_name, old_path);
   C_STRING(new_name, new_path);
   int from = open(old_name, O_RDONLY | O_CLOEXEC), to;
   if (from < 0) return false;
   to = open(new_name, O_WRONLY | O_TRUNC | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
   if (to >= 0) {
      do copied = sendfile(to, from, NULL, 1 << 30);
      while (copied > 0);
      if (close(to) != 0) copied = -1;
   }
   close(from);
   return copied == 0;
}

static int open_to_sync(const text_t *path)
{
   C_STRING(name, path);
   return open(name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
}

bool tiltpad_sync(const text_t *path)
{
   int file = open_to_sync(path), result;
   if (file < 0) return false;
   result = fsync(file);
   close(file);
   return result == 0;
}

void tiltpad_begin_sync(const text_t *path)
{
   int file = open_to_sync(path);
   if (file < 0) return;
   sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE);
   close(file);
}

/* Makes a folder, unless something of its name is there. */
bool tiltpad_make_folder(const text_t *path)
{
   C_STRING(name, path);
   return mkdir(name, 0777) == 0 || errno == EEXIST;
}

void tiltpad_remove_folder(const text_t *path)
{
   C_STRING(name, path);
   rmdir(name);
}

const char *tiltpad_other_number(const text_t *folder, int digits, long last)
{
   static char found[NAME_MAX + 1];
   C_STRING(folder_name, folder);
   DIR *names = opendir(folder_name);
   struct dirent *entry;
   *found = 0;
   while (names && (entry = readdir(names)) && !*found) {
      size_t length = strspn(entry->d_name, "0123456789");
      long number = strtol(entry->d_name, NULL, 10);
      if (length == 0 || strcmp(entry->d_name + length, ".h5") != 0) continue;
      if (length != (size_t)digits || number < 1 || number > last) strcpy(found, entry->d_name);
   }
   if (names) closedir(names);
   return found;
}

/* Names in the folder of a path that are that path's with ".IofN" and an ending, in order, each with a slash behind. */
const char *tiltpad_block_names(const text_t *path, const text_t *ending)
{
   static char *found;
   C_STRING(name, path);
   C_STRING(tail, ending);
   char *slash = strrchr(name, '/'), *stem = slash ? slash + 1 : name;
   struct dirent **entries;
   size_t length = 0, stem_length = strlen(stem);
   int count;
   if (slash) *slash = 0;
   count = scandir(!slash ? "." : *name ? name : "/", &entries, NULL, alphasort);
   found = realloc(found, 1);
   for (int i = 0; i < count; i++) {
      char *entry = entries[i]->d_name, *more;
      int end = 0;
      if (strncmp(entry, stem, stem_length) == 0) sscanf(entry + stem_length, ".%*[0-9]of%*[0-9]%n", &end);
      if (end > 0 && strcmp(entry + stem_length + end, tail) == 0
          && (more = realloc(found, length + strlen(entry) + 2))) {
         found = more;
         length += sprintf(found + length, "%s/", entry);
      }
      free(entries[i]);
   }
   if (count >= 0) free(entries);
   if (!found) return "";
   found[length] = 0;
   return found;
}

/* ---- a file that is open ----------------------------------------------------------------------- */

/* Its number, negative where it cannot be opened; a file that is written is there. */
int tiltpad_open(const text_t *path, bool writing)
{
   C_STRING(name, path);
   return open(name, (writing ? O_RDWR : O_RDONLY) | O_CLOEXEC);
}

long tiltpad_size(int file)
{
   struct stat status;
   return fstat(file, &status) == 0 ? (long)status.st_size : -1;
}

/* Writes bytes at a place, the end of the file; where it is full, nothing of them stays. */
bool tiltpad_write_at(int file, const text_t *bytes, long place)
{
   for (size_t done = 0; done < bytes->length;) {
      ssize_t now = pwrite(file, bytes->start + done, bytes->length - done, place + done);
      if (now < 0 && errno == EINTR) continue;
      if (now <= 0) {
         int reason = now < 0 ? errno : ENOSPC;
         if (ftruncate(file, place) != 0) reason = reason ? reason : errno;
         errno = reason;
         return false;
      }
      done += now;
   }
   return true;
}

/* False where it cannot be read, and where fewer bytes are there. */
bool tiltpad_read_at(int file, const text_t *bytes, long place)
{
   for (size_t done = 0; done < bytes->length;) {
      ssize_t now = pread(file, bytes->start + done, bytes->length - done, place + done);
      if (now < 0 && errno == EINTR) continue;
      if (now == 0) errno = EIO;
      if (now <= 0) return false;
      done += now;
   }
   return true;
}

bool tiltpad_sync_open(int file)
{
   return fdatasync(file) == 0;
}

/* CRC-32 (ISO 3309, as in zlib) of bytes behind others, whose checksum is `before`. */
int32_t tiltpad_crc32(const text_t *bytes, int32_t before)
{
   static uint32_t table[256];
   uint32_t sum = ~(uint32_t)before;
   if (!table[1]) {
      for (uint32_t i = 0; i < 256; i++) {
         table[i] = i;
         for (int bit = 0; bit < 8; bit++) table[i] = table[i] >> 1 ^ (table[i] & 1 ? 0xEDB88320u : 0);
      }
   }
   for (size_t i = 0; i < bytes->length; i++) sum = sum >> 8 ^ table[(sum ^ (unsigned char)bytes->start[i]) & 255];
   return (int32_t)~sum;
}

/* ---- locks ------------------------------------------------------------------------------------- */

/* Whether it can be a lock file: an ordinary file with this name alone, or with none any more. */
static int can_be_lock(const struct stat *status)
{
   return S_ISREG(status->st_mode) && status->st_nlink <= 1;
}

/* Opens a lock file, or makes it; -1 where that is not possible, -2 where the name is another thing's. */
int tiltpad_open_lock(const text_t *path)
{
   struct stat status;
   int file;
   C_STRING(name, path);
   /* looked at first, as opening a device can do something */
   if (lstat(name, &status) == 0 && !can_be_lock(&status)) return -2;
   file = open(name, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
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
bool tiltpad_has_name(int file, const text_t *path)
{
   struct stat open_one, named;
   C_STRING(name, path);
   return fstat(file, &open_one) == 0 && lstat(name, &named) == 0 && open_one.st_ino == named.st_ino &&
          open_one.st_dev == named.st_dev;
}

/* Reads the beginning of the file, at most as much as the text has room for, and returns how much; negative after a
   failure. */
int tiltpad_read_start(int file, text_t *text)
{
   return pread(file, text->start, text->length, 0);
}

/* Writes the text over the beginning of the file. */
bool tiltpad_write_start(int file, const text_t *text)
{
   return pwrite(file, text->start, text->length, 0) == (ssize_t)text->length;
}

/* ---- processes --------------------------------------------------------------------------------- */

/* A word, as it is one of the line in a lock file. */
const char *tiltpad_host_name(void)
{
   static char name[HOST_NAME_MAX + 1];
   if (gethostname(name, sizeof name) != 0 || !*name) strcpy(name, "unknown");
   for (char *letter = name; *letter; letter++)
      if (!isgraph((unsigned char)*letter)) *letter = '_';
   return name;
}

void tiltpad_pause(int seconds)
{
   sleep(seconds);
}

void tiltpad_set_environment(const text_t *name, const text_t *value)
{
   C_STRING(variable, name);
   C_STRING(its_value, value);
   setenv(variable, its_value, 0);
}

int tiltpad_processors(void)
{
   cpu_set_t set[64];
   memset(set, 0, sizeof set);
   if (sched_getaffinity(0, sizeof set, set) != 0) return 1;
   return CPU_COUNT_S(sizeof set, set);
}

bool tiltpad_is_alive(int process)
{
   return kill(process, 0) == 0 || errno != ESRCH;
}

bool tiltpad_can_have(long bytes)
{
   void *memory = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
   return memory != MAP_FAILED && munmap(memory, bytes) == 0;
}

bool tiltpad_is_terminal(void)
{
   return isatty(STDOUT_FILENO);
}

bool tiltpad_write_output(const text_t *text)
{
   size_t done = 0;
   while (done < text->length) {
      ssize_t now = write(STDOUT_FILENO, text->start + done, text->length - done);
      if (now <= 0) return false;
      done += now;
   }
   return true;
}

void tiltpad_end_with_parent(int parent)
{
   prctl(PR_SET_PDEATHSIG, SIGTERM);
   if (getppid() != parent) _exit(1);
}

bool tiltpad_open_pipe(int *ends)
{
   return pipe(ends) == 0;
}

void tiltpad_close_pipe(const int *ends)
{
   close(ends[0]);
   close(ends[1]);
}

void tiltpad_send(int pipe, const text_t *record)
{
   if (write(pipe, record->start, record->length) < 0) return;
}

bool tiltpad_receive(int pipe, text_t *record)
{
   return read(pipe, record->start, record->length) == (ssize_t)record->length;
}

void tiltpad_close_end(int end)
{
   close(end);
}

bool tiltpad_send_bytes(int pipe, const char *bytes, size_t length)
{
   while (length > 0) {
      ssize_t now = write(pipe, bytes, length);
      if (now < 0 && errno == EINTR) continue;
      if (now <= 0) return false;
      bytes += now;
      length -= now;
   }
   return true;
}

bool tiltpad_receive_bytes(int pipe, char *bytes, size_t length)
{
   while (length > 0) {
      ssize_t now = read(pipe, bytes, length);
      if (now < 0 && errno == EINTR) continue;
      if (now <= 0) return false;
      bytes += now;
      length -= now;
   }
   return true;
}

bool tiltpad_can_read(int pipe, int milliseconds)
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

void tiltpad_ignore_file_limit(void)
{
   signal(SIGXFSZ, SIG_IGN);
}

int tiltpad_received_signal(void)
{
   return received;
}
