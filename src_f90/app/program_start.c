/* What the program settles before its runtime and its libraries start: which variables of the environment they see,
   and what happens where there is no memory for them. Linked into the program alone, not into the library for Python. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stddef.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

/* ---- environment ------------------------------------------------------------------------------- */

/* The Fortran runtime's variables change texts that the program reads again, or put its output into files. Only those
   that make it write at once are left. Called before the runtime reads them. */
static void forget_runtime_variables(int count, char **arguments, char **environment)
{
   char **kept = environment;
   (void)count, (void)arguments;
   for (; *environment; environment++)
      if (strncmp(*environment, "GFORTRAN_", 9) != 0 || strncmp(*environment + 9, "UNBUFFERED_", 11) == 0)
         *kept++ = *environment;
   *kept = NULL;
}

/* ---- stack ------------------------------------------------------------------------------------- */

/* Bytes of stack that are enough for all arrays that are on it, and below which nothing is begun: zgbtrf of LAPACK has
   133 kB on it. */
enum { STACK = 8 << 20, LEAST_STACK = 256 << 10 };

/* A smaller stack than is usual (ulimit -s) is enlarged where the system allows it; it grows up to its limit. */
static void enlarge_stack(void)
{
   static const char line[] = "tiltpad: error: less than 256 kB of stack are allowed; ulimit -s 8192 allows 8 MB\n";
   struct rlimit limit, more;
   if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= STACK) return;
   more = (struct rlimit){STACK, limit.rlim_max < STACK ? STACK : limit.rlim_max};
   if (setrlimit(RLIMIT_STACK, &more) == 0) return;
   more = (struct rlimit){limit.rlim_max, limit.rlim_max};
   if (setrlimit(RLIMIT_STACK, &more) == 0) limit = more;
   if (limit.rlim_cur >= LEAST_STACK) return;
   if (write(STDERR_FILENO, line, sizeof line - 1) < 0) _exit(3);
   _exit(3);
}

/* ---- what comes first -------------------------------------------------------------------------- */

static void before_all(int count, char **arguments, char **environment)
{
   enlarge_stack();
   forget_runtime_variables(count, arguments, environment);
}

__attribute__((section(".preinit_array"), used))
static void (*const first)(int, char **, char **) = before_all;

/* ---- memory ------------------------------------------------------------------------------------ */

/* Few callers of malloc bear its failure: the runtime says it in many lines, libraries use what they have not got. The
   program's own functions stand for the system's, and end it instead, as a kill would: the last checkpoint stays. */
static void *checked(void *memory, size_t size)
{
   static const char line[] = "tiltpad: error: out of memory\n";
   if (memory || size == 0) return memory;
   if (write(STDERR_FILENO, line, sizeof line - 1) < 0) _exit(3);
   _exit(3);
}

/* The function of this name that would be called without the one here. */
#define NEXT(name) static __typeof__(name) *next; if (!next) next = (__typeof__(name) *)dlsym(RTLD_NEXT, #name)

void *malloc(size_t size)
{
   NEXT(malloc);
   return checked(next(size), size);
}

void *calloc(size_t count, size_t size)
{
   NEXT(calloc);
   return checked(next(count, size), count && size);
}

void *realloc(void *memory, size_t size)
{
   NEXT(realloc);
   return checked(next(memory, size), size);
}

void *memalign(size_t alignment, size_t size)
{
   NEXT(memalign);
   return checked(next(alignment, size), size);
}
