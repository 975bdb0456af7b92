#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "plan/engines/container_place.h"
#include "plan/engines/engine_files.h"
#include "plan/engines/template.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

constexpr const char* submit = R"sh(#!/bin/bash
# ./submit.sh QUEUE IMAGE FILESYSTEM renders plan.json with AWS Batch. The aws command must be configured.
#   QUEUE       name of a job queue on EC2
#   IMAGE       bdpt in a registry; build it from the Containerfile of bdpt
#   FILESYSTEM  fs-..., an Amazon EFS file system with the contents of
#               @SHARED@
# VCPUS=16 MEMORY=32768 ./submit.sh ... sets the vCPUs and the memory [MiB] of each task.
# Run it again to render what is missing: complete tasks end at once. The merge starts when all tasks have succeeded.
set -eu
[ $# = 3 ] || { echo "usage: $0 QUEUE IMAGE FILESYSTEM" >&2; exit 2; }
queue=$1 image=$2 filesystem=$3

container=$(cat <<JSON
{
  "image": "$image",
  "command": @TASK@,
  "user": "1000",
  "resourceRequirements": [
    {"type": "VCPU", "value": "${VCPUS:-4}"},
    {"type": "MEMORY", "value": "${MEMORY:-8192}"}
  ],
  "volumes": [{"name": "data", "efsVolumeConfiguration": {"fileSystemId": "$filesystem"}}],
  "mountPoints": [{"sourceVolume": "data", "containerPath": "/data"}]
}
JSON
)
overrides=$(cat <<JSON
@MERGE@
JSON
)
# Retries after reclaimed machines and SIGTERM (143), not after wrong input.
retry='{"attempts": 10, "evaluateOnExit": [
  {"onStatusReason": "Host EC2*", "action": "RETRY"},
  {"onExitCode": "143", "action": "RETRY"},
  {"onExitCode": "137", "action": "RETRY"},
  {"onReason": "*", "action": "EXIT"}]}'
definition=$(aws batch register-job-definition --job-definition-name @NAME@ --type container \
  --container-properties "$container" --retry-strategy "$retry" \
  --query jobDefinitionArn --output text)
job=$(aws batch submit-job --job-name @NAME@ --job-queue "$queue" --job-definition "$definition" \
  --array-properties size=@COUNT@ --query jobId --output text)
merge=$(aws batch submit-job --job-name @NAME@-merge --job-queue "$queue" --job-definition "$definition" \
  --depends-on jobId="$job" --container-overrides "$overrides" --query jobId --output text)
echo "tasks: job $job; merge: job $merge"
)sh";

/// Escapes text for a here-document in which the shell expands variables.
std::string in_here_document(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        result += c == '\\' || c == '$' || c == '`' ? std::string{'\\', c} : std::string{c};
    }
    return result;
}

}  // namespace

std::vector<EngineFile> aws_batch_files(const Plan& plan, const std::filesystem::path& folder)
{
    using nlohmann::json;
    const ContainerPlace place = container_place(plan, folder);
    const std::string file = (place.working / "plan.json").string();
    const json task{"render", "--plan", file, "--task", "env:AWS_BATCH_JOB_ARRAY_INDEX", "--quiet"};
    const json merge{{"command", {"merge", "--plan", file}}};
    return {{.name = "submit.sh",
             .text = filled(submit, {{"SHARED", one_line(place.shared.string())},
                                     {"NAME", job_name(folder)},
                                     {"COUNT", fmt::format("{}", plan.tasks.size())},
                                     {"TASK", in_here_document(task.dump())},
                                     {"MERGE", in_here_document(merge.dump())}}),
             .kind = FileKind::program}};
}

}  // namespace bdpt::app
