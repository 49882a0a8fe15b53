/* The program tiltpad of a wheel: starts the build of it that suits this processor, from libexec/tiltpad. */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int main(int argc, char **argv) {
   char self[PATH_MAX], build[PATH_MAX + 64];
   const char *processor = "any";
   ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
   if (length > 0) {
      self[length] = '\0';
      *strrchr(self, '/') = '\0';
#ifdef __x86_64__
      if (__builtin_cpu_supports("x86-64-v3")) processor = "x86-64-v3";
#endif
      snprintf(build, sizeof build, "%s/../libexec/tiltpad/%s", self, processor);
      execv(build, argv);
   }
   fprintf(stderr, "tiltpad: error: %s: %s\n", length > 0 ? build : "/proc/self/exe", strerror(errno));
   return argc > 0 ? 3 : 1;
}
