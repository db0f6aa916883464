// Replaces the C library's allocation functions by ones that count and forward, because Eigen calls malloc instead of
// operator new. Address and thread sanitizers have replaced them already, so their hook counts.

#include "tests/support/allocation_counter.h"

#include <cerrno>
#include <cstddef>

namespace {
thread_local long count = 0;
}

long ursula::allocations() { return count; }

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)  // clang's test for sanitizers
#define URSULA_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define URSULA_SANITIZER
#endif

#if defined(URSULA_SANITIZER)

// <sanitizer/allocator_interface.h>, which GCC does not always have
extern "C" int __sanitizer_install_malloc_and_free_hooks(  // NOLINT
    void (*malloc_hook)(const volatile void*, std::size_t), void (*free_hook)(const volatile void*));

namespace {
const int installed = __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t) { ++count; },
                                                                [](const volatile void*) {});
}

#else

extern "C" {

void* __libc_malloc(std::size_t size);                           // NOLINT: the C library's names
void* __libc_calloc(std::size_t n, std::size_t size);            // NOLINT
void* __libc_realloc(void* old, std::size_t size);               // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT

void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}

void* calloc(std::size_t n, std::size_t size) {
  ++count;
  return __libc_calloc(n, size);
}

void* realloc(void* old, std::size_t size) {
  ++count;
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  ++count;
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  *out = memalign(alignment, size);
  return *out == nullptr ? ENOMEM : 0;
}

}  // extern "C"

#endif
