#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "common/core/expected.hpp"
#include "common/process/environment.hpp"
#include "services/lukou/home.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

namespace fs = std::filesystem;

struct NewArguments {
  std::string name;
  std::string language = "cpp";
};

/// "my_rsu" -> "MyRsu".
std::string class_name(const std::string& name) {
  std::string of_class;
  bool capital = true;
  for (const char letter : name) {
    if (letter == '_') {
      capital = true;
    } else {
      of_class += capital && letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
      capital = false;
    }
  }
  return of_class;
}

void replace_all(std::string& text, const std::string& word, const std::string& by) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size())) {
    text.replace(at, word.size(), by);
  }
}

Expected<Done> write_from_template(const fs::path& from, const fs::path& folder, const std::string& name,
                                   const Home& home) {
  std::ifstream in(from);
  std::stringstream content;
  content << in.rdbuf();
  std::string text = content.str();
  replace_all(text, "@NAME@", name);
  replace_all(text, "@CLASS@", class_name(name));
  replace_all(text, "@LUKOU_DIR@", home.package.string());
  replace_all(text, "@LUKOU_PYTHON@", home.python.string());
  std::string file = from.stem().string();  // without ".in"
  replace_all(file, "NAME", name);
  std::ofstream out(folder / file);
  out << text;
  out.close();
  if (!in || !out) return Error{(folder / file).string(), "cannot be written"};
  return Done{};
}

Expected<Done> make(const NewArguments& arguments) {
  const Home home = find_home();
  const fs::path templates = home.templates / arguments.language;
  if (!fs::is_directory(templates)) return Error{templates.string(), "is missing: install Lukou again"};
  const fs::path folder = arguments.name;
  std::error_code code;
  if (fs::exists(folder)) return Error{folder.string(), "is there already; choose another name, or remove it"};
  fs::create_directory(folder, code);
  if (code) return Error{folder.string(), "cannot be made: " + code.message()};
  for (const auto& entry : fs::directory_iterator(templates)) {
    if (auto done = write_from_template(entry.path(), folder, arguments.name, home); !done) return done;
  }
  return Done{};
}

int run(const NewArguments& arguments) {
  if (auto done = make(arguments); !done) return report_errors(done.error());
  std::printf("made %s; %s/README.md says how to build, test and run it\n", arguments.name.c_str(),
              arguments.name.c_str());
  return process::kExitDone;
}

}  // namespace

Action add_new(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("new", "begin an RSU of your own");
  CLI::App* rsu = verb->add_subcommand("rsu", "a folder with an algorithm, its test and a README");
  verb->require_subcommand(1);
  auto arguments = std::make_shared<NewArguments>();
  rsu->add_option("name", arguments->name, "of the folder and of the algorithm")
      ->required()
      ->check([](const std::string& name) {
        const bool plain = !name.empty() && name.size() <= 40 && name.front() >= 'a' && name.front() <= 'z' &&
                           name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
        return plain && name != "lukou" ? std::string()
                                        : "must begin with a small letter and hold small letters, digits and `_` only";
      });
  rsu->add_option("--lang", arguments->language, "cpp or python")
      ->check(CLI::IsMember({"cpp", "python"}))
      ->capture_default_str();
  return [arguments] { return run(*arguments); };
}

}  // namespace lukou
