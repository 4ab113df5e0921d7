// morsel serve --database DB: the database in the browser.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <morsel/serve.hpp>
#include <string>
#include <thread>

#include "commands.hpp"
#include "numbers.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel serve --database shapes.db                  then open the address that it prints
  morsel serve --database shapes.db --port 0         any port that is free
  morsel serve --database shapes.db --host 0.0.0.0 --token - < token.txt

Only this machine can reach it unless --host says otherwise; then a token is needed. Nothing is
encrypted: between machines put it behind a TLS proxy or an SSH tunnel. Ctrl-C stops it.)";

struct Arguments {
  std::filesystem::path database;
  ServeOptions options;
};

// The first line of standard input, which no list of processes shows.
std::string token_from_input() {
  std::string token;
  std::getline(std::cin, token);
  if (token.ends_with('\r')) token.pop_back();
  return token;
}

void serve_until_interrupted(Server& server) {
  Task task;
  std::jthread answering([&] { server.run(); });
  while (!task.progress().cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.stop();
}

int run_serve(Arguments arguments) {
  if (arguments.options.token == "-") arguments.options.token = token_from_input();
  arguments.options.check();
  const Database database = Database::open(arguments.database, Access::kRead);
  Server server(database, arguments.options);
  say(fmt::format("{} shows {} ({} shapes); Ctrl-C stops\n", server.address(),
                  database.file().string(), database.size()));
  serve_until_interrupted(server);
  return kDone;
}

}  // namespace

void add_serve(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("serve", "Show a database in the browser");
  const auto arguments = std::make_shared<Arguments>();
  ServeOptions& options = arguments->options;
  add_database(*command, arguments->database);
  command->add_option("--host", options.host, "Address to listen on [127.0.0.1]")
      ->option_text("ADDRESS")
      ->group("Server");
  add(*command, "--port", "N", "0 for any that is free [8642]",
      [&options](const std::string& name, const std::string& text) {
        options.port = static_cast<int>(whole_number(name, text, 0, 65535));
      })
      ->group("Server");
  command
      ->add_option("--token", options.token,
                   "What visitors must know; - reads it from standard input")
      ->option_text("TOKEN")
      ->group("Server");
  add(*command, "--most-upload", "MB", "Largest file that visitors may hand in [64]",
      [&options](const std::string& name, const std::string& text) {
        options.most_upload_bytes = static_cast<std::size_t>(whole_number(name, text, 1, 4096))
                                    << 20;
      })
      ->group("Server");
  add_threads(*command, options.threads, "Server");
  command->footer(kExamples);
  command->group("Look-alikes");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_serve(*arguments); }; });
}

}  // namespace morsel::cli
