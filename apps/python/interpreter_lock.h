#pragma once

#include <cxxabi.h>
#include <nanobind/nanobind.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace bdpt::python {

/// Sleeps until the process has ended.
[[noreturn]] inline void sleep_forever()
{
    for (;;) {
        ::pause();
    }
}

/// Returns the result of `work`, which may take the interpreter's lock. While the interpreter ends,
/// Python up to 3.13 unwinds the stack of another thread that requests the lock, and the C++
/// functions below end the process with an abort. The thread sleeps here instead until the process
/// has ended, as it does in Python itself from 3.14 on.
template <typename Work>
decltype(auto) sleep_when_python_ends(Work&& work)
{
    try {
        return std::forward<Work>(work)();
    } catch (const abi::__forced_unwind&) {
        sleep_forever();
    }
}

/// Tracks the threads that work in C++ without the interpreter's lock. When Python ends, the
/// process destroys what they use (the threads of oneTBB, devices of Embree), so the end waits for
/// them.
class Workers {
public:
    static Workers& all()
    {
        static Workers& workers = *new Workers;  // never destroyed: threads may outlive main()
        return workers;
    }

    /// Registers a thread. Called after releasing the lock.
    void begin()
    {
        std::unique_lock lock(mutex_);
        if (must_sleep()) {
            lock.unlock();
            sleep_forever();
        }
        ++count_;
    }
    /// Takes the lock by `take`, and unregisters the thread, which the end waits for; when Python
    /// ends, this does not return.
    template <typename Take>
    void end(const Take& take)
    {
        {
            std::unique_lock lock(mutex_);
            if (must_sleep()) {
                --count_;
                lock.unlock();
                none_.notify_all();
                sleep_forever();
            }
        }
        sleep_when_python_ends(take);
        {
            const std::lock_guard lock(mutex_);
            --count_;
        }
        none_.notify_all();
    }

    /// Returns a token that stops renders after the pass in flight when Python ends.
    [[nodiscard]] std::stop_token stop()
    {
        const std::lock_guard lock(mutex_);
        return ending_thread_ == std::this_thread::get_id() ? std::stop_token()
                                                            : python_ends_.get_token();
    }

    /// Waits until no thread works. Called without the interpreter's lock when Python ends;
    /// afterwards only the caller's own thread may work.
    void finish()
    {
        std::unique_lock lock(mutex_);
        ending_thread_ = std::this_thread::get_id();
        python_ends_.request_stop();
        none_.wait(lock, [this] { return count_ == 0; });
    }

private:
    Workers() = default;
    [[nodiscard]] bool must_sleep() const
    {
        return ending_thread_ && ending_thread_ != std::this_thread::get_id();
    }

    std::mutex mutex_;
    std::condition_variable none_;
    int count_ = 0;
    std::optional<std::thread::id> ending_thread_;
    std::stop_source python_ends_;
};

/// Releases the interpreter's lock during its lifetime, so that other threads of Python run.
class Unlocked {
public:
    Unlocked() : state_(PyEval_SaveThread()) { Workers::all().begin(); }
    ~Unlocked()
    {
        Workers::all().end([this] { PyEval_RestoreThread(state_); });
    }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    PyThreadState* state_;
};

/// Holds the lock again, within the lifetime of an `Unlocked`.
class Locked {
public:
    Locked()
    {
        Workers::all().end([this] { state_ = PyGILState_Ensure(); });
    }
    ~Locked()
    {
        PyGILState_Release(state_);
        Workers::all().begin();
    }
    Locked(const Locked&) = delete;
    Locked& operator=(const Locked&) = delete;

private:
    PyGILState_STATE state_{};
};

}  // namespace bdpt::python
