#include "report/image/attempts.h"

#include <string>

namespace bdpt::app {

void Attempts::finish() const
{
    if (errors_.empty()) {
        return;
    }
    std::string message;
    for (const Error& error : errors_) {
        message += (message.empty() ? "" : "; ") + std::string(error.what());
    }
    throw Error(errors_.front().code(), message);
}

}  // namespace bdpt::app
