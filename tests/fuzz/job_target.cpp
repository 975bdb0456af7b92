#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz_target.h"
#include "input_file.h"
#include "options/option_list.h"
#include "options/render_arguments.h"
#include "promises.h"

using namespace bdpt;
using namespace bdpt::job;

namespace {

/// The options of `bdpt render`, and where their values go.
struct Options {
    Options() { add_render_options(list, request); }
    Options(const Options&) = delete;
    Options& operator=(const Options&) = delete;

    RenderRequest request;
    OptionList list;
};

/// What a job says is written in the same words, and loads no code.
void check_job(const std::string& file)
{
    Options first;
    load_job(file, first.list);
    fuzz::promise(!first.request.arguments.denoise.library, "a job loads no code");
    const std::string text = job_text(first.list, file);
    const fuzz::InputFile written;
    const auto again =
        written.write(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    Options second;
    load_job(again, second.list);
    fuzz::promise(to_words(first.list).size() == to_words(second.list).size(),
                  "a job is read as written", text);
    static_cast<void>(checked(first.request, first.list));
}

}  // namespace

/// Jobs, as strangers may have written them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::InputFile input;
    try {
        check_job(input.write(data, size).string());
    } catch (const Error& error) {
        if (error.code() != ErrorCode::usage) {  // options that do not go together
            fuzz::check_refusal(error);
        }
    }
    return 0;
}
