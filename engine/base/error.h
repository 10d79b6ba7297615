// What a Firn program can fail with. The codes are the exit codes of the command line and part of its
// contract.
#pragma once

#include <stdexcept>
#include <string>

namespace firn {

enum class ExitCode {
  ok = 0,
  input = 2,        // the scene, an option or a file it names is wrong
  environment = 3,  // a folder, permission or package is missing
  io = 4,           // a write failed: full disk, quota, hardware
  in_use = 5,       // the output belongs to another run
  numerics = 6,     // the simulation left the range in which it means something
  resources = 7,    // it would not fit into memory
  interrupted = 130,
  terminated = 143,
};

/// An error that ends the program with `code`; `what()` is the whole message for the user, one line or
/// several.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace firn
