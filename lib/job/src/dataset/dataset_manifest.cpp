#include "dataset/dataset.h"

#include <bdpt/error.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* manifest_name = "manifest.jsonl";

/// Returns the lines that are whole; what a killed process or a full disk left of others is lost.
std::vector<ordered_json> read_lines(const fs::path& file)
{
    std::vector<ordered_json> lines;
    std::ifstream stream(file);
    for (std::string text; std::getline(stream, text);) {
        ordered_json line = ordered_json::parse(text, nullptr, false);
        if (line.is_object()) {
            lines.push_back(std::move(line));
        }
    }
    return lines;
}

std::optional<std::size_t> number_of(const ordered_json& line, const char* key)
{
    const auto found = line.find(key);
    return found != line.end() && found->is_number_unsigned()
               ? std::optional(found->get<std::size_t>())
               : std::nullopt;
}

}  // namespace

std::vector<std::string> files_of(const ordered_json& line)
{
    std::vector<std::string> files;
    const auto found = line.find("files");
    if (found != line.end() && found->is_array()) {
        for (const ordered_json& file : *found) {
            if (file.is_string()) {
                files.push_back(file.get<std::string>());
            }
        }
    }
    return files;
}

ModelManifest::ModelManifest(fs::path folder, const ContentHash& key)
    : folder_(std::move(folder)), key_(to_string(key))
{
    for (const ordered_json& line : read_lines(folder_ / manifest_name)) {
        if (!line.contains("key")) {
            continue;  // a failure
        }
        is_ours_ = is_ours_ && line.at("key") == key_;
        const std::vector<std::string> files = files_of(line);
        files_.insert(files_.end(), files.begin(), files.end());
        if (const std::optional<std::size_t> view = number_of(line, "view")) {
            views_[*view] = files;
        } else {
            complete_ = number_of(line, "views");
        }
    }
    const auto is_missing = [&](const auto& view) { return !has(view.first, view.second); };
    if (complete_ &&
        (views_.size() != *complete_ || std::any_of(views_.begin(), views_.end(), is_missing))) {
        complete_.reset();  // somebody removed files
    }
}

bool ModelManifest::has(std::size_t view, const std::vector<std::string>& files) const
{
    const auto found = views_.find(view);
    return found != views_.end() && found->second == files &&
           std::all_of(files.begin(), files.end(), [&](const std::string& file) {
               std::error_code ignored;
               return fs::exists(folder_ / file, ignored);
           });
}

void ModelManifest::clear()
{
    std::error_code ignored;
    for (const std::string& file : files_) {
        if (fs::path(file).filename() == file) {  // in the folder
            fs::remove(folder_ / file, ignored);
        }
    }
    fs::remove(folder_ / manifest_name, ignored);
    views_.clear();
    files_.clear();
    complete_.reset();
    is_ours_ = true;
}

void ModelManifest::add(ordered_json line)
{
    line["key"] = key_;
    append_line(folder_, line);
}

void append_line(const fs::path& folder, const ordered_json& line)
{
    std::error_code ignored;
    fs::create_directories(folder, ignored);
    const fs::path file = folder / manifest_name;
    const auto fail = [&] {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: {}", file.string(), std::strerror(errno)));
    };
    const int descriptor = ::open(file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        fail();
    }
    std::string text = line.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
    char last = '\n';
    const off_t size = ::lseek(descriptor, 0, SEEK_END);
    if (size > 0 && ::pread(descriptor, &last, 1, size - 1) == 1 && last != '\n') {
        text.insert(text.begin(), '\n');  // ends the line of a killed process
    }
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    const bool is_whole = written == static_cast<ssize_t>(text.size());
    const int error = written < 0 ? errno : ENOSPC;
    ::close(descriptor);
    if (!is_whole) {
        errno = error;
        fail();
    }
}

std::vector<ordered_json> final_lines(const fs::path& folder)
{
    std::map<std::size_t, ordered_json> views;
    std::optional<ordered_json> rest;
    for (ordered_json& line : read_lines(folder / manifest_name)) {
        const std::optional<std::size_t> view = number_of(line, "view");
        (view ? views[*view] : rest.emplace()) = std::move(line);
    }
    std::vector<ordered_json> lines;
    for (auto& [view, line] : views) {
        lines.push_back(std::move(line));
    }
    if (rest) {
        lines.push_back(std::move(*rest));
    }
    return lines;
}

}  // namespace bdpt::job
