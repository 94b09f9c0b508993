// SPDX-License-Identifier: GPL-3.0-or-later
// dataset workflow: a sweep in chunks for Snakemake, on one machine or a cluster.
#include <coagula/common/checks.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/dataset.hpp>
#include <coagula/stages/output_file.hpp>

#include <filesystem>

namespace coagula::stages {

namespace {

namespace fs = std::filesystem;

std::string snakefile(std::int64_t chunks) {
    return "# Makes the data set of sweep.toml in chunks: snakemake --cores 2, or snakemake --profile slurm\n"
           "CHUNKS = " +
           std::to_string(chunks) +
           "\n\n"
           "rule all:\n"
           "    input: \"set.h5\"\n\n"
           "rule chunk:\n"
           "    input: \"sweep.toml\"\n"
           "    output: \"chunks/{number}.h5\"\n"
           "    threads: 1\n"
           "    shell: \"coagula dataset run {input} -o {output} --chunk {wildcards.number}/{CHUNKS} --jobs {threads} --quiet\"\n\n"
           "rule join:\n"
           "    input: expand(\"chunks/{number}.h5\", number=range(1, CHUNKS + 1))\n"
           "    output: \"set.h5\"\n"
           "    shell: \"coagula dataset join {input} -o {output} --force --quiet\"\n";
}

/// Snakemake 7 takes the command of the scheduler from the profile.
const char* const slurm_profile =
    "# snakemake --profile slurm (Snakemake 7)\n"
    "cluster: \"sbatch --parsable --cpus-per-task={threads} --mem={resources.mem_mb} --time={resources.runtime} "
    "--output=slurm/job-%j.log\"\n"
    "cluster-status: sh slurm/status.sh\n"
    "cluster-cancel: scancel\n"
    "jobs: 100\n"
    "default-resources:\n"
    "  - mem_mb=2000\n"
    "  - runtime=240\n"
    "latency-wait: 60\n"
    "rerun-incomplete: true\n";

/// Without it Snakemake 7 would wait for ever for a job that Slurm could not start.
const char* const slurm_status =
    "# What became of a job: sh status.sh JOB\n"
    "state=$(scontrol -o show job \"$1\" 2>/dev/null | sed -n 's/.* JobState=\\([A-Z_]*\\).*/\\1/p')\n"
    "if [ -z \"$state\" ]; then  # it ended some time ago\n"
    "  state=$(sacct -n -X -j \"$1\" -o State 2>/dev/null | head -n 1 | tr -d ' ')\n"
    "fi\n"
    "case \"$state\" in\n"
    "  COMPLETED) echo success ;;\n"
    "  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | RESIZING) echo running ;;\n"
    "  *) echo failed ;;\n"
    "esac\n";

/// Snakemake 8 has an executor of its own, the package snakemake-executor-plugin-slurm.
const char* const slurm_profile_8 =
    "# snakemake --profile slurm8 (Snakemake 8 with snakemake-executor-plugin-slurm)\n"
    "executor: slurm\n"
    "jobs: 100\n"
    "default-resources:\n"
    "  mem_mb: 2000\n"
    "  runtime: 240\n"
    "latency-wait: 60\n"
    "rerun-incomplete: true\n";

}  // namespace

Printed write_workflow(const Sweep& sweep, const std::string& folder, std::int64_t chunks, bool overwrite) {
    const fs::path place(folder);
    const std::vector<std::pair<fs::path, std::string>> files = {{place / "Snakefile", snakefile(chunks)},
                                                                 {place / "sweep.toml", sweep.text},
                                                                 {place / "slurm" / "config.yaml", slurm_profile},
                                                                 {place / "slurm" / "status.sh", slurm_status},
                                                                 {place / "slurm8" / "config.yaml", slurm_profile_8}};
    for (const char* part : {"", "slurm", "slurm8"}) {
        io::make_folder(place / part);
    }
    for (const auto& [path, text] : files) {
        check_not_read(path.string(), sweep.path, {});
        io::check_output(path.string(), overwrite);
    }
    Json names = Json::array();
    for (const auto& [path, text] : files) {
        io::write_file(path.string(), text, overwrite);
        names.push_back(path.string());
    }
    return {{{"files", names}, {"chunks", chunks}, {"structures", sweep.rows.size()}},
            {{"chunks", std::to_string(chunks) + " of " + std::to_string(sweep.rows.size()) + " structures"},
             {"written to", folder},
             {"next", "snakemake --directory '" + folder + "' --snakefile '" + (place / "Snakefile").string() + "' --cores 2"}}};
}

Verb dataset_workflow_verb() {
    return {.name = "dataset workflow",
            .summary = "a workflow of Snakemake that makes the set in chunks, also on a Slurm cluster",
            .input = "SWEEP.toml",
            .options = {required(output("folder to write it into")),
                        count("chunks", "parts of the sweep, a job each", "16", within(1, 100000)),
                        flag("force", "replace existing files")},
            .notes = {"Files that the sweep names are found from the folder of the workflow: name them by absolute paths."}};
}

}  // namespace coagula::stages
