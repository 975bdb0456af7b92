#include "terminal/temporary_folder.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <cstdlib>
#include <string>
#include <system_error>

namespace bdpt::app {

TemporaryFolder::TemporaryFolder()
{
    std::error_code error;
    std::string name = (std::filesystem::temp_directory_path(error) / "bdpt-XXXXXX").string();
    if (error || ::mkdtemp(name.data()) == nullptr) {
        throw Error(ErrorCode::output, fmt::format("{}: cannot make a temporary folder", name));
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace bdpt::app
