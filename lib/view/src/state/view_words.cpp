#include "state/view_state.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "messages/text.h"
#include "options/option_list.h"

namespace bdpt::view {

ViewWords::ViewWords(const OptionList& given)
{
    const RenderOptionList render;
    for (const Option& option : given.all()) {
        if (option.given() && render.list.find(option.name()) != nullptr) {
            texts_[option.name()] = option.texts;
        }
    }
    // Views show any number of samples, and rates that auto chooses need multiples of a group.
    sets_adaptive_ = !has("--adaptive") && !has("--rates");
    if (sets_adaptive_) {
        set("--adaptive", "false");
    }
}

void ViewWords::set(std::string_view option, std::string text)
{
    texts_.insert_or_assign(std::string(option), std::vector{std::move(text)});
    arguments_.reset();
}

void ViewWords::remove(std::string_view option)
{
    if (const auto found = texts_.find(option); found != texts_.end()) {
        texts_.erase(found);
        arguments_.reset();
    }
}

void ViewWords::set_given_file(std::string_view option, const std::filesystem::path& path,
                               std::string name)
{
    given_.insert_or_assign(path.string(), std::move(name));
    set(option, path.string());
}

std::string ViewWords::with_own_names(std::string text) const
{
    for (const auto& [path, name] : given_) {
        if (const std::size_t place = text.find(path); place != std::string::npos) {
            text.replace(place, path.size(), name);
        }
    }
    return text;
}

bool ViewWords::has(std::string_view option) const
{
    return texts_.find(option) != texts_.end();
}

std::string ViewWords::text(std::string_view option) const
{
    const auto found = texts_.find(option);
    return found != texts_.end() ? found->second.back() : "";
}

void ViewWords::give_to(OptionList& options) const
{
    for (Option& option : options.all()) {
        if (const auto found = texts_.find(option.name()); found != texts_.end()) {
            option.texts = found->second;
        }
    }
    options.store_given();
}

const RenderArguments& ViewWords::arguments() const
{
    if (!arguments_) {
        RenderOptionList render;
        const bool is_unlimited = !has("--spp") && !has("--noise");
        (is_unlimited ? ending_after(view_samples) : *this).give_to(render.list);
        RenderArguments arguments = checked(render.request, render.list);
        // As in the command for what is seen, which ends at no noise.
        arguments.options.sampling.planned_samples =
            has("--spp") ? *render.request.spp : SamplingOptions{}.planned_samples;
        arguments_ = std::make_shared<const RenderArguments>(std::move(arguments));
    }
    return *arguments_;
}

ViewWords ViewWords::ending_after(std::int64_t samples) const
{
    ViewWords result = *this;
    result.remove("--noise");
    result.set("--spp", std::to_string(samples));
    return result;
}

ViewWords ViewWords::final_words() const
{
    ViewWords result = *this;
    if (sets_adaptive_) {
        result.remove("--adaptive");
    }
    return result;
}

std::string ViewWords::command(std::int64_t samples) const
{
    ViewWords result = *this;
    result.remove("--noise");
    result.set("--samples", "0:" + std::to_string(samples));
    return result.line();
}

std::string ViewWords::final_command() const
{
    return final_words().line();
}

std::string ViewWords::line() const
{
    RenderOptionList render;
    give_to(render.list);
    std::string line = "bdpt render";
    for (const std::string& word : to_words(render.list)) {
        line += " " + shell_word(with_own_names(word));
    }
    return line;
}

std::string ViewWords::final_job() const
{
    RenderOptionList render;
    ViewWords absolute = final_words();
    for (const Option& option : render.list.all()) {
        const auto found = absolute.texts_.find(option.name());
        if (found == absolute.texts_.end() || !option.info.is_path) {
            continue;
        }
        for (std::string& text : found->second) {
            if (const auto own = given_.find(text); own != given_.end()) {
                text = own->second;
            } else if (!is_among(option.info.words, text)) {
                text = std::filesystem::absolute(text).lexically_normal().string();
            }
        }
    }
    absolute.give_to(render.list);
    return job_text(render.list, "job.json");
}

}  // namespace bdpt::view
