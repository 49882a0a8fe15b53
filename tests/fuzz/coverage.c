/* Which edges of the flow a case reaches: the compiler calls __sanitizer_cov_trace_pc in every block
   (-fsanitize-coverage=trace-pc). An edge counts anew when it is taken twice, four times, ... as often. */
#include <stdint.h>
#include <string.h>

enum { edges = 1 << 16 };
static uint8_t now[edges], before[edges];
static uintptr_t last;

void __sanitizer_cov_trace_pc(void)
{
   /* relative to this function, so that the place in memory does not matter */
   uintptr_t here = (uintptr_t)__builtin_return_address(0) - (uintptr_t)&__sanitizer_cov_trace_pc;
   uint8_t *edge = &now[(here ^ last) & (edges - 1)];
   if (*edge < 255) ++*edge;
   last = here >> 1;
}

void coverage_start(void)
{
   memset(now, 0, sizeof now);
   last = 0;
}

int coverage_news(void)
{
   int news = 0;
   for (int i = 0; i < edges; ++i) {
      uint8_t most = 0;
      for (uint8_t count = now[i]; count > 0; count >>= 1) ++most;
      if (most > before[i]) {
         before[i] = most;
         ++news;
      }
   }
   return news;
}
