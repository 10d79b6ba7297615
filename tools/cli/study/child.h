// One run of a study, in a process of its own: what fails there, or runs out of memory, ends that run only.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace firn {

struct StudyChildOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  int threads = 1, repeats = 1;
  std::filesystem::path points;  // written at the end
};

/// `firn study-run`: prints one line of JSON with what the run was and took.
int run_study_child(const StudyChildOptions& options, std::ostream& out);

/// The words after the program that ask for it.
std::vector<std::string> study_child_arguments(const StudyChildOptions& options);

}  // namespace firn
