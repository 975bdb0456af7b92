#pragma once

#include <bdpt/error.h>

#include <utility>
#include <vector>

namespace bdpt::app {

/// Steps that are all attempted even if some of them fail, so that an image is not lost because
/// another file cannot be written.
class Attempts {
public:
    /// Calls `work()`; returns false if it threw an `Error`.
    template <typename Work>
    bool run(const Work& work)
    {
        try {
            work();
            return true;
        } catch (const Error& error) {
            errors_.push_back(error);
            return false;
        }
    }
    /// Throws one `Error` for all failures, if any, with the code of the first.
    void finish() const;

private:
    std::vector<Error> errors_;
};

}  // namespace bdpt::app
