#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace bdpt::io {

/// Collects warnings. Those of one kind are counted and become one line with the first place.
class Warnings {
public:
    /// Adds a warning. `kind` says what is odd and what is done about it; `place` where, and which
    /// value.
    void add(const std::string& kind, const std::string& place);

    /// Returns one line per kind, in the order of their first appearance.
    [[nodiscard]] std::vector<std::string> lines() const;

private:
    friend class Silence;
    struct Entry {
        std::string kind;
        std::string first_place;
        std::size_t count = 0;
    };

    std::vector<Entry> entries_;
    std::map<std::string, std::size_t> index_;
    bool silent_ = false;
};

/// Discards warnings during its lifetime, for work that is repeated and warns the first or last
/// time.
class Silence {
public:
    explicit Silence(Warnings& warnings) : warnings_(warnings), before_(warnings.silent_)
    {
        warnings.silent_ = true;
    }
    ~Silence() { warnings_.silent_ = before_; }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    Warnings& warnings_;
    bool before_;
};

}  // namespace bdpt::io
