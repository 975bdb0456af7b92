#include "stage/memory_budget.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <optional>
#include <string>

#include "options/film_memory.h"

namespace bdpt::app {

std::uint64_t reserved_bytes(const RenderArguments& arguments)
{
    if (!arguments.max_memory) {
        return 0;
    }
    // Without --size, as large as it can be.
    const Size size = arguments.size.value_or(default_size(std::nullopt));
    const std::uint64_t bytes = film_bytes(arguments.options, size);
    if (bytes >= *arguments.max_memory) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("the film of {}x{} pixels takes {} bytes, but the limit is {} "
                                "(--max-memory); a smaller --size, --crop or fewer layers of --aov "
                                "take less",
                                size.width, size.height, bytes, *arguments.max_memory));
    }
    return bytes;
}

PreparedScene prepare_within_memory(RenderArguments arguments)
{
    const std::uint64_t film = reserved_bytes(arguments);
    if (film == 0) {
        return prepare_scene(arguments);
    }
    const std::uint64_t left = *arguments.max_memory - film;
    arguments.scene.limits = io::limits_within(left);
    try {
        return prepare_scene(arguments);
    } catch (const Error& error) {
        const std::string message = error.what();
        if (message.find("limit is") == std::string::npos &&
            message.find("of memory in all") == std::string::npos) {
            throw;
        }
        throw Error(error.code(), fmt::format("{} (--max-memory {} less {} for the film)", message,
                                              *arguments.max_memory, film));
    }
}

}  // namespace bdpt::app
