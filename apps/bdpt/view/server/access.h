#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::app {

/// 128 bits that nobody can guess, in 32 digits. Throws `Error` (internal) if the system has none.
[[nodiscard]] std::string random_token();

/// Are they equal? Takes the same time wherever texts of one length differ.
[[nodiscard]] bool are_equal_in_constant_time(std::string_view a, std::string_view b);

/// Why a request is not answered.
struct Refusal {
    int status = 403;  ///< of HTTP
    std::string line;
};

/// What of a request says who asks.
struct RequestHead {
    std::string_view method;
    std::string_view target;
    std::string_view host;
    std::optional<std::string_view> origin{};
};

/// Who may ask, and for what.
class Access {
public:
    /// `host` is where the server listens, as the user named it.
    Access(std::string token, std::string host);

    /// None: `path_of` tells what is asked for.
    [[nodiscard]] std::optional<Refusal> refusal(const RequestHead& head) const;
    /// The part of `target` behind the token, without the query.
    [[nodiscard]] static std::string_view path_of(std::string_view target);
    /// What comes behind '?'.
    [[nodiscard]] static std::string_view query_of(std::string_view target);

private:
    [[nodiscard]] bool is_ours(std::string_view host) const;

    std::string token_;
    std::string host_;
    bool listens_everywhere_;
};

}  // namespace bdpt::app
