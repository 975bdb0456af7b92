#pragma once

#include <bdpt/error.h>

#include <utility>
#include <vector>

namespace bdpt::app {

/// Steps that are all tried, also when some of them fail: so that an image is not lost because
/// another file cannot be written.
class Attempts {
public:
    /// Does `work()`; whether it threw no `Error`.
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
    /// Throws one `Error` for all that failed, if any did, with the code of the first.
    void finish() const;

private:
    std::vector<Error> errors_;
};

}  // namespace bdpt::app
