#pragma once

#include <cxxabi.h>
#include <nanobind/nanobind.h>
#include <unistd.h>

#include <utility>

namespace bdpt::python {

/// What `work` returns, which may take the interpreter's lock. While the interpreter ends, Python
/// up to 3.13 unwinds the stack of another thread that wants the lock, and the C++ functions below
/// end the process with an abort. The thread sleeps here instead until the process has ended, as it
/// does in Python itself from 3.14 on.
template <typename Work>
decltype(auto) sleep_when_python_ends(Work&& work)
{
    try {
        return std::forward<Work>(work)();
    } catch (const abi::__forced_unwind&) {
        for (;;) {
            ::pause();
        }
    }
}

/// Lets other threads of Python run meanwhile.
class Unlocked {
public:
    Unlocked() : state_(PyEval_SaveThread()) {}
    ~Unlocked()
    {
        sleep_when_python_ends([this] { PyEval_RestoreThread(state_); });
    }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    PyThreadState* state_;
};

/// Holds the lock again, within the life of an `Unlocked`.
class Locked {
public:
    Locked() : state_(sleep_when_python_ends([] { return PyGILState_Ensure(); })) {}
    ~Locked() { PyGILState_Release(state_); }
    Locked(const Locked&) = delete;
    Locked& operator=(const Locked&) = delete;

private:
    PyGILState_STATE state_;
};

}  // namespace bdpt::python
