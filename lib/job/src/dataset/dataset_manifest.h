#pragma once

#include <bdpt/part/content_hash.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::job {

/// The lines about one model, in manifest.jsonl of its folder: one for each view whose files are
/// all there, one when all views are, and one for each failure. Lines are appended, so that a
/// process that is killed leaves all of them but the last, which may be cut off.
class ModelManifest {
public:
    /// Reads the lines that are there. `key` is the hash of all that the views depend on.
    ModelManifest(std::filesystem::path folder, const ContentHash& key);

    /// Tests whether all lines are of the same key.
    [[nodiscard]] bool is_ours() const { return is_ours_; }
    /// Tests whether all views and their poses are there.
    [[nodiscard]] bool is_complete() const { return complete_.has_value(); }
    /// Returns the number of views of a complete model.
    [[nodiscard]] std::size_t count() const { return complete_.value_or(0); }
    /// Tests whether a view is there, with all its `files`.
    [[nodiscard]] bool has(std::size_t view, const std::vector<std::string>& files) const;

    /// Removes all views that the lines name, and the lines.
    void clear();
    /// Appends a view; "view" is its number. Throws `Error` (output).
    void add_view(nlohmann::ordered_json line);
    /// Appends that all views are there. Throws `Error` (output).
    void add_end(nlohmann::ordered_json line);

private:
    std::filesystem::path folder_;
    std::string key_;
    bool is_ours_ = true;
    std::optional<std::size_t> complete_{};
    std::map<std::size_t, std::vector<std::string>> views_;  // files by number
    std::vector<std::string> files_;                         // of all lines
};

/// Appends `line` to the manifest in `folder`, which is created if necessary. Throws `Error`
/// (output).
void append_line(const std::filesystem::path& folder, const nlohmann::ordered_json& line);

/// Returns the lines of the manifest in `folder` that are to be kept: one for each view, the last
/// of the others, in the order of views. Empty if there is none.
[[nodiscard]] std::vector<nlohmann::ordered_json> final_lines(const std::filesystem::path& folder);

/// Returns the names of the files of a line, the image first; empty if it has none.
[[nodiscard]] std::vector<std::string> files_of(const nlohmann::ordered_json& line);

}  // namespace bdpt::job
