#pragma once

#include <bdpt/job.h>

#include "terminal/console.h"
#include "terminal/interrupt.h"
#include "terminal/text.h"

namespace bdpt::job {

/// Passes messages and progress to the callbacks of a program.
class CallbackConsole final : public app::Console {
public:
    explicit CallbackConsole(const JobControl& control) : control_(control) {}

private:
    void show_event(std::string_view /*name*/, const nlohmann::ordered_json& /*fields*/) override {}
    void show_note(const app::Note& note) override { tell(MessageKind::note, note.text); }
    void show_warning(std::string_view message) override { tell(MessageKind::warning, message); }
    void show_progress(const Progress& progress, const app::Goal& goal) override
    {
        if (control_.on_progress) {
            control_.on_progress({.image = label().index,
                                  .images = label().count,
                                  .fraction = fraction_done(progress, goal),
                                  .seconds_left = time_left(progress, goal),
                                  .render = progress});
        }
    }
    void show_task(const app::TaskProgress& /*progress*/) override {}
    void finish_progress() override {}

    void tell(MessageKind kind, std::string_view message)
    {
        if (control_.on_message) {
            control_.on_message(kind, app::one_line(message));
        }
    }

    const JobControl& control_;
};

/// Stops a render by the token of a program.
class TokenInterrupt final : public app::Interrupt {
public:
    explicit TokenInterrupt(std::stop_token stop) : stop_(std::move(stop)) {}

    void set_outputs(app::PendingOutputs /*outputs*/) override {}
    void allow_stop() override {}
    void forbid_stop() override {}
    [[nodiscard]] std::stop_token stop_token() const override { return stop_; }
    [[nodiscard]] std::optional<std::string> stopped_by() const override
    {
        return stop_.stop_requested() ? std::optional<std::string>("the program") : std::nullopt;
    }
    [[nodiscard]] bool take_checkpoint_request() override { return false; }

private:
    std::stop_token stop_;
};

}  // namespace bdpt::job
