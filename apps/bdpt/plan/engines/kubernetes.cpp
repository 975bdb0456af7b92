#include <bdpt/version.h>
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "plan/engines/container_place.h"
#include "plan/engines/engine_files.h"
#include "plan/engines/template.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

constexpr const char* head = R"(# kubectl apply -f kubernetes.yaml
# Renders plan.json as an Indexed Job, and merges the parts (Kubernetes 1.29 or later). Change these fields:
# - image: bdpt in a registry that your cluster can reach; build it from the Containerfile of bdpt
# - claimName: a PersistentVolumeClaim that all pods can write to (ReadWriteMany), with the contents of
#   @SHARED@ (subPath, beside mountPath, names a folder of the claim)
# - resources: CPUs and memory of each task
# To render what is missing, run kubectl delete -f, then apply: complete tasks end at once.
)";

constexpr const char* job = R"(---
apiVersion: batch/v1
kind: Job
metadata:
  name: @NAME@
spec:@HOW@
  template:
    spec:
      restartPolicy: Never
      terminationGracePeriodSeconds: 120
      securityContext:
        runAsNonRoot: true
        runAsUser: 1000
        runAsGroup: 1000
        fsGroup: 1000
      containers:
        - name: bdpt
          image: bdpt:@VERSION@
          workingDir: @WORKING@
          args: @ARGS@
          resources:
            requests: {cpu: "4", memory: 4Gi}
            limits: {cpu: "4", memory: 4Gi}
          volumeMounts:
            - {name: data, mountPath: /data}
      volumes:
        - name: data
          persistentVolumeClaim: {claimName: bdpt}
)";

// 143: the pod was evicted, and has written its part. 2 to 5: retrying in another pod would not
// help.
constexpr const char* how_tasks = R"(
  completionMode: Indexed
  completions: @COUNT@
  parallelism: @COUNT@
  backoffLimitPerIndex: 6
  podFailurePolicy:
    rules:
      - action: Ignore
        onPodConditions:
          - {type: DisruptionTarget, status: "True"}
      - action: Ignore
        onExitCodes: {containerName: bdpt, operator: In, values: [143]}
      - action: FailJob
        onExitCodes: {containerName: bdpt, operator: In, values: [2, 3, 4, 5]})";

constexpr const char* how_merge = R"(
  backoffLimit: 6)";

}  // namespace

std::vector<EngineFile> kubernetes_files(const Plan& plan, const std::filesystem::path& folder)
{
    using nlohmann::json;
    const ContainerPlace place = container_place(plan, folder);
    const std::string how_many =
        filled(how_tasks, {{"COUNT", fmt::format("{}", plan.tasks.size())}});
    const auto format_job = [&](const std::string& name, const std::string& how, const json& args) {
        return filled(job, {{"HOW", how},
                            {"NAME", name},
                            {"VERSION", BDPT_VERSION},
                            {"WORKING", json(place.working.string()).dump()},
                            {"ARGS", args.dump()}});
    };
    // Kubernetes replaces $(...) by the index.
    const json task{"render", "--plan", "plan.json", "--task", "$(JOB_COMPLETION_INDEX)",
                    "--quiet"};
    const json merge{"merge", "--plan", "plan.json", "--wait"};
    const std::string name = job_name(folder);
    return {{.name = "kubernetes.yaml",
             .text = filled(head, {{"SHARED", one_line(place.shared.string())}}) +
                     format_job(name, how_many, task) +
                     format_job(name + "-merge", how_merge, merge)}};
}

}  // namespace bdpt::app
