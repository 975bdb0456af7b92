#include "call_counter.h"

#include <dlfcn.h>
#include <pthread.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>

namespace bdpt::test {
namespace {

// A counter for functions that have no object of ours at hand.
thread_local RuntimeCalls calls;

}  // namespace

RuntimeCalls runtime_calls() noexcept
{
    return calls;
}

}  // namespace bdpt::test

namespace {

using bdpt::test::calls;

template <typename Function>
Function* original(const char* name)
{
    void* found = dlsym(RTLD_NEXT, name);
    if (found == nullptr) {
        std::abort();  // there is nothing that could do the work
    }
    return reinterpret_cast<Function*>(found);
}

}  // namespace

extern "C" {

// The functions behind those of libc: dlsym() would have to allocate first.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

[[gnu::visibility("default")]] void* malloc(std::size_t size)
{
    ++calls.allocations;
    return __libc_malloc(size);
}

[[gnu::visibility("default")]] void* calloc(std::size_t count, std::size_t size)
{
    ++calls.allocations;
    return __libc_calloc(count, size);
}

[[gnu::visibility("default")]] void* realloc(void* old, std::size_t size)
{
    ++calls.allocations;
    return __libc_realloc(old, size);
}

[[gnu::visibility("default")]] void* memalign(std::size_t alignment, std::size_t size)
{
    ++calls.allocations;
    return __libc_memalign(alignment, size);
}

[[gnu::visibility("default")]] void* aligned_alloc(std::size_t alignment, std::size_t size)
{
    return memalign(alignment, size);
}

[[gnu::visibility("default")]] int posix_memalign(void** result, std::size_t alignment,
                                                  std::size_t size)
{
    *result = memalign(alignment, size);
    return *result != nullptr ? 0 : ENOMEM;
}

[[gnu::visibility("default")]] int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept
{
    static auto* const lock = original<int(pthread_mutex_t*)>("pthread_mutex_lock");
    ++calls.locks;
    return lock(mutex);
}

[[gnu::visibility("default")]] int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept
{
    static auto* const lock = original<int(pthread_mutex_t*)>("pthread_mutex_trylock");
    ++calls.locks;
    return lock(mutex);
}

[[gnu::visibility("default")]] int pthread_rwlock_rdlock(pthread_rwlock_t* rwlock) noexcept
{
    static auto* const lock = original<int(pthread_rwlock_t*)>("pthread_rwlock_rdlock");
    ++calls.locks;
    return lock(rwlock);
}

[[gnu::visibility("default")]] int pthread_rwlock_wrlock(pthread_rwlock_t* rwlock) noexcept
{
    static auto* const lock = original<int(pthread_rwlock_t*)>("pthread_rwlock_wrlock");
    ++calls.locks;
    return lock(rwlock);
}

[[gnu::visibility("default")]] int pthread_spin_lock(pthread_spinlock_t* spinlock) noexcept
{
    static auto* const lock = original<int(pthread_spinlock_t*)>("pthread_spin_lock");
    ++calls.locks;
    return lock(spinlock);
}

[[gnu::visibility("default"), noreturn]] void __cxa_throw(void* exception, void* type,
                                                          void (*destructor)(void*))
{
    using Throw = void(void*, void*, void (*)(void*));
    static auto* const cxa_throw = original<Throw>("__cxa_throw");
    ++calls.throws;
    cxa_throw(exception, type, destructor);
    std::abort();
}

}  // extern "C"
