// The command line. Each subcommand is a file of its own; this one only names their options.

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/output/posix_file.h"
#include "tools/cli/bench.h"
#include "tools/cli/bench_weights.h"
#include "tools/cli/element.h"
#include "tools/cli/info.h"
#include "tools/cli/materials.h"
#include "tools/cli/memory.h"
#include "tools/cli/path/path.h"
#include "tools/cli/path/reader.h"
#include "tools/cli/plan.h"
#include "tools/cli/run.h"
#include "tools/cli/schema.h"
#include "tools/cli/study/child.h"
#include "tools/cli/study/reader.h"
#include "tools/cli/study/study.h"
#include "tools/cli/version.h"

namespace {

using Action = std::function<int()>;

CLI::App* add(CLI::App& app, const char* name, const char* what, const char* example) {
  CLI::App* command = app.add_subcommand(name, what);
  command->footer(std::string("Example:\n  ") + example);
  return command;
}

CLI::Option* add_overrides(CLI::App* command, std::vector<std::string>& overrides) {
  // One value a flag: the scene's name may follow.
  return command
      ->add_option("--set", overrides, "Replace a value of the file, as in --set simulation.cfl=0.2")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_run(CLI::App& app, Action& action) {
  auto options = std::make_shared<firn::RunOptions>();
  auto memory = std::make_shared<std::string>();
  CLI::App* c = add(app, "run", "Simulate a scene and write its caches",
                    "firn run scenes/snowball.toml --out out/snowball --set simulation.cell_size=0.01");
  c->add_option("scene", options->scene, "The scene file")->required();
  c->add_option("--out", options->out, "Folder for the caches; out/NAME if left out");
  add_overrides(c, options->overrides);
  c->add_option("--frames", options->frames, "Write only frames A to B and end after B; frame 1 is t = 0")
      ->type_name("A:B");
  c->add_option("--threads", options->threads,
                "Threads that simulate; all cores if left out. One more writes the frames")
      ->check(CLI::Range(1, 1024));
  c->add_option("--max-memory", *memory, "Refuse to start if it would need more, as in 8G")
      ->type_name("SIZE");
  c->add_flag("--overwrite", options->overwrite, "Replace the frames of an earlier run in the same folder");
  c->callback([=, &action] {
    action = [=] {
      if (!memory->empty()) options->max_memory = firn::parse_bytes(*memory);
      return firn::run_scene(*options);
    };
  });
}

void add_plan(CLI::App& app, Action& action) {
  auto scene = std::make_shared<std::filesystem::path>();
  auto overrides = std::make_shared<std::vector<std::string>>();
  auto json = std::make_shared<bool>(false);
  CLI::App* c = add(app, "plan", "Show what a scene would simulate and cost, without running it",
                    "firn plan scenes/snowball.toml");
  c->add_option("scene", *scene, "The scene file")->required();
  add_overrides(c, *overrides);
  c->add_flag("--json", *json, "As JSON");
  c->callback(
      [=, &action] { action = [=] { return firn::run_plan(*scene, *overrides, *json, std::cout); }; });
}

/// `bench` has its options.
void add_bench_weights(CLI::App& bench, Action& action) {
  auto options = std::make_shared<firn::BenchWeightsOptions>();
  CLI::App* c = add(bench, "weights",
                    "Measure what weights cost: computed where they are used, stored by axis, stored by node",
                    "firn bench weights --rounds 10");
  // They are of scenes: without this they would be accepted and ignored.
  for (CLI::Option* option : bench.get_options())
    if (option != bench.get_help_ptr()) c->excludes(option);
  c->add_option("--particles", options->particles, "About so many, eight in a cell [1000000]")
      ->check(CLI::Range(1, 100000000));
  c->add_option("--rounds", options->rounds,
                "Measure everything so many times, in turns; the best counts [5]")
      ->check(CLI::Range(1, 1000));
  c->add_flag("--json", options->json, "A line of JSON per measurement instead of CSV");
  c->callback([=, &action] { action = [=] { return firn::run_bench_weights(*options, std::cout); }; });
}

void add_bench(CLI::App& app, Action& action) {
  auto options = std::make_shared<firn::BenchOptions>();
  CLI::App* c =
      add(app, "bench", "Measure particle updates per second, pass by pass, beside what the machine could do",
          "firn bench scenes/snowball.toml --threads 1,2 --steps 100");
  c->add_option(
      "scene", options->scenes,
      "Scene files, or the built-in cases elastic and snow; if left out, these two in float, snow in "
      "double, and snow in float with avx2");
  add_overrides(c, options->overrides);
  c->add_option("--threads", options->threads,
                "Each of these numbers of threads; 1 and all cores if left out")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024));
  c->add_option("--isa", options->isas,
                "Each of these instruction sets: avx512, avx2, sse4; the widest if left out")
      ->delimiter(',')
      ->type_name("SET");
  c->add_option("--rounds", options->rounds,
                "Measure everything so many times, in turns; the best counts [5]")
      ->check(CLI::Range(1, 1000));
  c->add_option("--steps", options->steps, "End each round after so many steps")
      ->check(CLI::Range(1, 1000000));
  c->add_option("--vs", options->vs, "Compare with another build of firn: both take turns as child processes")
      ->type_name("BINARY");
  c->add_flag("--json", options->json, "A line of JSON per measurement instead of CSV");
  add_bench_weights(*c, action);
  c->callback([=, &action] {
    // Called after those of what stands below it.
    if (c->get_subcommands().empty()) action = [=] { return firn::run_bench(*options, std::cout); };
  });
}

void add_study(CLI::App& app, Action& action) {
  auto options = std::make_shared<firn::StudyOptions>();
  auto example = std::make_shared<bool>(false);
  CLI::App* c = add(app, "study", "Measure what accuracy costs in time, over any settings of any scene",
                    "firn study tools/study/bar.toml --error 1%");
  CLI::Option* study = c->add_option("study", options->study, "The study file");
  c->add_option("--out", options->out,
                "Folder for the results; out/NAME if left out. What is there is not run again");
  c->add_flag("--list", options->list, "Only list the runs with the time each will take");
  c->add_option("--of", options->quantity, "The quantity whose errors are printed [displacement]")
      ->check(CLI::IsMember({"displacement", "velocity", "stress"}));
  CLI::Option* error =
      c->add_option("--error", options->error,
                    "Print the settings that reach this error soonest, to paste after firn run")
          ->type_name("ERROR");
  c->add_option("--budget", options->budget, "Print the most accurate settings within this time")
      ->type_name("TIME")
      ->excludes(error);
  c->add_flag("--example", *example, "Print a commented study with every key")->excludes(study);
  c->callback([=, &action] {
    if (options->study.empty() && !*example) throw CLI::RequiredError("study");
    action = [=] {
      if (!*example) return firn::run_study(*options, std::cout);
      std::cout << firn::example_study();
      return 0;
    };
  });
}

/// What a study starts for each of its runs.
void add_study_child(CLI::App& app, Action& action) {
  auto options = std::make_shared<firn::StudyChildOptions>();
  CLI::App* c = app.add_subcommand("study-run")->group("");
  c->add_option("scene", options->scene)->required();
  add_overrides(c, options->overrides);
  c->add_option("--threads", options->threads);
  c->add_option("--repeats", options->repeats);
  c->add_option("--points", options->points)->required();
  c->callback([=, &action] { action = [=] { return firn::run_study_child(*options, std::cout); }; });
}

void add_element(CLI::App& app, Action& action) {
  auto options = std::make_shared<firn::PathOptions>();
  auto example = std::make_shared<bool>(false);
  CLI::App* c = add(app, "element",
                    "Lead a material along a strain path; without one drive single points: JSON lines in, "
                    "JSON lines out",
                    "firn element tools/element/copper_uniaxial.toml --out copper.csv\n"
                    "  echo "
                    "'{\"id\":\"a\",\"dimension\":2,\"dt\":1e-3,\"material\":{\"model\":\"neo_hookean\","
                    "\"mu\":1,\"lam\":1},"
                    "\"F_trial\":[[1.1,0],[0,1]]}' | firn element");
  CLI::Option* path = c->add_option("path", options->path, "The path file: lab tests of one specimen");
  c->add_option("--out", options->out, "File for the CSV; standard output if left out")->needs(path);
  add_overrides(c, options->overrides)->needs(path);
  c->add_flag("--example", *example, "Print a commented path")->excludes(path);
  c->callback([=, &action] {
    action = [=] {
      if (*example) std::cout << firn::example_path();
      if (*example) return 0;
      return options->path.empty() ? firn::run_element(std::cin, std::cout)
                                   : firn::run_element_path(*options, std::cout);
    };
  });
}

void add_materials(CLI::App& app, Action& action) {
  auto name = std::make_shared<std::string>();
  auto markdown = std::make_shared<bool>(false);
  CLI::App* c = add(app, "materials", "The material models: parameters, units, ranges, defaults, sources",
                    "firn materials snow_stomakhin_2013");
  c->add_option("name", *name, "One model in detail");
  c->add_flag("--markdown", *markdown, "The README's table");
  c->callback([=, &action] {
    action = [=] {
      return *markdown ? firn::run_materials_markdown(std::cout) : firn::run_materials(*name, std::cout);
    };
  });
}

void add_info(CLI::App& app, Action& action) {
  auto options = std::make_shared<firn::InfoOptions>();
  CLI::App* c = add(app, "info", "What a frame or the folder of a run holds",
                    "firn info out/snowball/particles.0012.vdb --csv v,Jp > frame_12.csv");
  c->add_option("path", options->path, "A frame, as particles.0012.vdb, or the folder of a run")->required();
  CLI::Option* json = c->add_flag("--json", options->json, "As JSON");
  c->add_option("--csv", options->csv,
                "A row a particle of a frame instead: its id, its place, and the attributes named")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->excludes(json);
  c->callback([=, &action] { action = [=] { return firn::run_info(*options, std::cout); }; });
}

void add_schema(CLI::App& app, Action& action) {
  auto example = std::make_shared<bool>(false);
  CLI::App* c =
      add(app, "schema", "The scene format as a JSON Schema", "firn schema --example > my_scene.toml");
  c->add_flag("--example", *example, "A commented scene with every key instead");
  c->callback([=, &action] { action = [=] { return firn::run_schema(*example, std::cout); }; });
}

/// CLI11 would only say that a subcommand is missing.
void check_command(const CLI::App& app, const std::string& word) {
  if (word.empty() || word[0] == '-') return;
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  std::vector<std::string_view> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) == names.end())
    throw firn::Error(firn::ExitCode::input, firn::unknown_name("command", word, names));
}

int run(CLI::App& app, int argc, char** argv) {
  Action action;
  add_run(app, action);
  add_plan(app, action);
  add_bench(app, action);
  add_study(app, action);
  add_study_child(app, action);
  add_element(app, action);
  add_materials(app, action);
  add_info(app, action);
  add_schema(app, action);
  if (argc > 1) check_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return static_cast<int>(firn::ExitCode::input);
  }
  const int code = action();
  std::cout.flush();
  if (!std::cout) throw firn::Error(firn::ExitCode::io, "could not write to standard output");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  firn::ignore_file_size_signals();
  CLI::App app("Firn: snow and plasticity by the material point method", "firn");
  app.set_version_flag("--version", std::string("firn ") + firn::kVersion);
  app.require_subcommand(1);
  try {
    return run(app, argc, argv);
  } catch (const firn::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    std::cerr << "out of memory\n";
    return static_cast<int>(firn::ExitCode::resources);
  }
}
