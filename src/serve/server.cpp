// Addresses to answers: who may ask, what is asked for, and what to say when it fails.

#include <fmt/format.h>

#include <charconv>
#include <exception>
#include <map>
#include <morsel/error.hpp>
#include <morsel/serve.hpp>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/threads.hpp"
#include "serve/answers.hpp"
#include "serve/app_page.hpp"
#include "serve/guard.hpp"
#include "serve/http_server.hpp"
#include "serve/turns.hpp"
#include "serve/uploads.hpp"
#include "serve/watched_work.hpp"

namespace morsel {
namespace {

using httplib::Request;
using httplib::Response;
using serve::QueryShape;

constexpr const char* kJson = "application/json";
constexpr std::size_t kMostText = 2048;  // of a parameter

// What the answer is when it is not what was asked for.
struct Failure {
  int status = 0;
  std::string message;
};

serve::Caller caller_of(const Request& request) {
  return {request.get_header_value("Host"), request.get_header_value("Origin"),
          request.get_header_value("Sec-Fetch-Site"), request.get_header_value("Authorization"),
          request.get_header_value("Cookie")};
}

void fail(Response& response, const Failure& failure) {
  response.status = failure.status;
  response.set_content(serve::error_json(failure.message), kJson);
  if (failure.status == 503) response.set_header("Retry-After", "2");
  if (failure.status == 401) response.set_header("WWW-Authenticate", "Bearer");
}

// What a status of httplib's own means here.
const char* sentence_of(int status) {
  switch (status) {
    case 400:
      return "This is no request that can be understood.";
    case 404:
      return "There is nothing at this address.";
    case 413:
      return "The request is too large.";
    case 414:
      return "The address is too long.";
    default:
      return "The request failed.";
  }
}

std::optional<std::string> parameter(const Request& request, const char* name) {
  if (!request.has_param(name)) return std::nullopt;
  if (request.get_param_value_count(name) > 1) {
    throw Failure{400, fmt::format("{} is given more than once", name)};
  }
  std::string value = request.get_param_value(name);
  if (value.size() > kMostText) {
    throw Failure{400, fmt::format("{} has more than {} bytes", name, kMostText)};
  }
  return value;
}

std::string needed(const Request& request, const char* name) {
  auto value = parameter(request, name);
  if (!value || value->empty()) throw Failure{400, fmt::format("{} is missing", name)};
  return *std::move(value);
}

std::size_t number(const Request& request, const char* name, std::size_t otherwise,
                   std::size_t least, std::size_t most) {
  const auto text = parameter(request, name);
  if (!text) return otherwise;
  std::size_t value = 0;
  const char* const end = text->data() + text->size();
  const auto read = std::from_chars(text->data(), end, value);
  if (read.ec != std::errc() || read.ptr != end || value < least || value > most) {
    throw Failure{400, fmt::format("{} must be a whole number, {} to {}", name, least, most)};
  }
  return value;
}

serve::ShapeChoice choice_of(const Request& request) {
  return {parameter(request, "text").value_or(""), parameter(request, "class")};
}

Failure no_such_upload() {
  return {404, "There is no such upload; it may have been too long ago."};
}

Failure too_large(const ServeOptions& options) {
  return {413, fmt::format("The file is too large: this server takes at most {} MB.",
                           options.most_upload_bytes >> 20)};
}

// The last part of what a browser calls a file, for messages and titles.
std::string file_name(std::string name) {
  name = name.substr(name.find_last_of("/\\") + 1);
  constexpr std::size_t kMost = 200;
  if (name.size() > kMost) name.erase(0, name.size() - kMost);  // the extension is at the end
  return name.empty() ? "file" : name;
}

}  // namespace

bool has_web_app() noexcept { return !serve::app_page().empty(); }

class Server::Service {
 public:
  Service(const Database& database, const ServeOptions& options);

  [[nodiscard]] const std::string& address() const { return address_; }
  void run() { http_.listen_after_bind(); }
  void stop() noexcept {
    uploads_.stop();
    http_.begin_stop();
  }

 private:
  int listen();
  void add_routes();
  /// The JSON text that `make` gives, when it has its turn among `turns`; null: at once.
  template <class Make>
  void get_json(const char* path, serve::Turns* turns, const Make& make);

  [[nodiscard]] StoredShape stored(const std::string& name) const;
  [[nodiscard]] std::shared_ptr<const serve::Uploaded> uploaded(const std::string& id) const;
  [[nodiscard]] QueryShape query(const Request& request) const;
  [[nodiscard]] std::string parts(const Request& request) const;
  [[nodiscard]] std::vector<std::string> matrix_names(const Request& request) const;
  [[nodiscard]] std::string matrix(const std::vector<std::string>& names,
                                   const Progress* progress) const;
  void thumbnail(const Request& request, Response& response);
  void log_in(const Request& request, Response& response);
  void receive(const Request& request, Response& response, const httplib::ContentReader& reader);
  void report_upload(const Request& request, Response& response);
  void report_matrix(const Request& request, Response& response);
  httplib::Server::HandlerResponse admit(const Request& request, Response& response) const;

  const Database& database_;
  const ServeOptions options_;
  serve::HttpServer http_;
  int port_;
  std::string address_;
  serve::Guard guard_;
  serve::Turns searches_;  // without, some would wait much longer than others for the database
  serve::Turns heavy_;
  serve::Uploads uploads_;
};

namespace {

ServeOptions checked(const ServeOptions& options) {
  options.check();
  if (!has_web_app()) {
    throw Error(ErrorCode::kUsage,
                "this build of morsel has no web app; install Node.js and npm and build it again");
  }
  return options;
}

Failure failure_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Failure& failure) {
    return failure;
  } catch (const Error& error) {
    const bool theirs = error.code() == ErrorCode::kUsage;
    return {theirs ? 400 : 500, error.what()};
  } catch (const std::bad_alloc&) {
    return {503, "There is not enough memory at the moment."};
  } catch (const std::exception& error) {
    return {500, fmt::format("internal error, please report it: {}", error.what())};
  } catch (...) {
    return {500, "internal error, please report it"};
  }
}

bool write_event(httplib::DataSink& sink, const std::string& json) {
  const std::string event = "data: " + json + "\n";  // the JSON ends with a line break
  return sink.write(event.data(), event.size());
}

// Keeps the connection, and finds out whether the other side is still there.
bool write_heartbeat(httplib::DataSink& sink) { return sink.write(":\n\n", 3); }

}  // namespace

Server::Service::Service(const Database& database, const ServeOptions& options)
    : database_(database),
      options_(checked(options)),
      port_(listen()),
      address_(fmt::format("http://{}:{}/", serve::in_url(options.host), port_)),
      guard_(options.host, port_, options.token),
      searches_(static_cast<std::size_t>(resolve_threads(0))),
      heavy_(static_cast<std::size_t>(resolve_threads(0))),
      uploads_(options) {
  http_.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                             {"Referrer-Policy", "no-referrer"},
                             {"Cross-Origin-Resource-Policy", "same-origin"},
                             {"Cross-Origin-Opener-Policy", "same-origin"},
                             {"Cache-Control", "no-store"},
                             {"Content-Security-Policy", serve::policy_of(serve::app_page())}});
  http_.set_pre_routing_handler(
      [this](const Request& request, Response& response) { return admit(request, response); });
  http_.set_exception_handler(
      [](const Request&, Response& response, const std::exception_ptr& thrown) {
        fail(response, failure_of(thrown));
      });
  http_.set_error_handler([](const Request&, Response& response) {
    if (response.body.empty()) fail(response, {response.status, sentence_of(response.status)});
  });
  add_routes();
}

int Server::Service::listen() {
  const int port = options_.port == 0 ? http_.bind_to_any_port(options_.host)
                   : http_.bind_to_port(options_.host, options_.port) ? options_.port
                                                                      : -1;
  if (port > 0) return port;
  throw Error(ErrorCode::kResource,
              fmt::format("cannot listen on {} port {}: another program may have it, or it is not "
                          "this machine's; port 0 takes any that is free",
                          options_.host, options_.port));
}

// Before anything of a body is read.
httplib::Server::HandlerResponse Server::Service::admit(const Request& request,
                                                        Response& response) const {
  using Handling = httplib::Server::HandlerResponse;
  const serve::Caller caller = caller_of(request);
  const auto refusal = request.path == "/"              ? guard_.check_page(caller)
                       : request.path == "/api/session" ? guard_.check_site(caller)
                                                        : guard_.check_call(caller);
  if (refusal) {
    fail(response, {refusal->status, refusal->reason});
    return Handling::Handled;
  }
  if (request.get_header_value_count("Content-Length") > 1 ||
      (request.has_header("Content-Length") && request.has_header("Transfer-Encoding")) ||
      request.has_header("Content-Encoding")) {
    fail(response, {400, "A body must come as it is, with one length."});
    return Handling::Handled;
  }
  if (request.get_header_value<std::uint64_t>("Content-Length") > options_.most_upload_bytes) {
    fail(response, too_large(options_));
    return Handling::Handled;
  }
  return Handling::Unhandled;
}

template <class Make>
void Server::Service::get_json(const char* path, serve::Turns* turns, const Make& make) {
  http_.Get(path, [turns, make](const Request& request, Response& response) {
    const std::string text =
        turns != nullptr ? turns->take([&] { return make(request); }) : std::string(make(request));
    response.set_content(text, kJson);
  });
}

void Server::Service::add_routes() {
  http_.Get("/", [](const Request&, Response& response) {
    const std::string_view page = serve::app_page();
    response.set_content(page.data(), page.size(), "text/html; charset=utf-8");
  });
  get_json("/api/database", nullptr,
           [this](const Request&) { return serve::database_json(database_, options_); });
  get_json("/api/shapes", nullptr, [this](const Request& request) {
    return serve::shapes_json(database_, choice_of(request),
                              number(request, "offset", 0, 0, 1'000'000'000),
                              number(request, "limit", 60, 1, serve::kMostListed));
  });
  get_json("/api/shape", nullptr, [this](const Request& request) {
    return serve::stored_shape_json(stored(needed(request, "name")));
  });
  get_json("/api/search", &searches_, [this](const Request& request) {
    return serve::search_json(database_, query(request),
                              number(request, "top", 10, 1, serve::kMostHits));
  });
  get_json("/api/picture", &heavy_,
           [this](const Request& request) { return serve::sketch_json(query(request).data); });
  get_json("/api/parts", &heavy_, [this](const Request& request) { return parts(request); });
  get_json("/api/match", &heavy_, [this](const Request& request) {
    return serve::match_json(query(request), stored(needed(request, "with")));
  });
  get_json("/api/matrix", &heavy_,
           [this](const Request& request) { return matrix(matrix_names(request), nullptr); });
  http_.Get("/api/matrix/events", [this](const Request& request, Response& response) {
    report_matrix(request, response);
  });
  http_.Get("/api/thumbnail",
            [this](const Request& request, Response& response) { thumbnail(request, response); });
  http_.Get("/api/upload", [this](const Request& request, Response& response) {
    const std::string id = needed(request, "id");
    const auto state = uploads_.state(id);
    if (!state) throw no_such_upload();
    response.set_content(serve::upload_json(id, *state), kJson);
  });
  http_.Get("/api/upload/events", [this](const Request& request, Response& response) {
    report_upload(request, response);
  });
  http_.Delete("/api/upload", [this](const Request& request, Response& response) {
    if (!uploads_.cancel(needed(request, "id"))) {
      throw no_such_upload();
    }
    response.status = 204;
  });
  http_.Post("/api/session", [this](const Request& request, Response& response,
                                    const httplib::ContentReader& reader) {
    Request whole = request;
    reader([&](const char* data, std::size_t size) {
      whole.body.append(data, size);
      return whole.body.size() <= kMostText;
    });
    log_in(whole, response);
  });
  http_.Post("/api/uploads",
             [this](const Request& request, Response& response,
                    const httplib::ContentReader& reader) { receive(request, response, reader); });
}

StoredShape Server::Service::stored(const std::string& name) const {
  if (!database_.find(name)) {
    throw Failure{404, fmt::format("There is no shape called {} in the database.", name)};
  }
  return database_.get(name);
}

std::shared_ptr<const serve::Uploaded> Server::Service::uploaded(const std::string& id) const {
  auto found = uploads_.result(id);
  if (!found) throw no_such_upload();
  return found;
}

QueryShape Server::Service::query(const Request& request) const {
  const auto id = parameter(request, "upload");
  if (!id) {
    const std::string name = needed(request, "name");
    return {name, true, stored(name).data};
  }
  if (request.has_param("name")) throw Failure{400, "give either name or upload, not both"};
  const auto found = uploaded(*id);
  return {found->name, false, found->data};
}

std::string Server::Service::parts(const Request& request) const {
  const auto id = parameter(request, "upload");
  if (!id) return serve::parts_json(stored(needed(request, "name")));
  return uploaded(*id)->parts;
}

std::vector<std::string> Server::Service::matrix_names(const Request& request) const {
  std::vector<std::string> names = serve::chosen_names(database_, choice_of(request));
  if (names.size() <= serve::kMostMatrixShapes) return names;
  throw Failure{422, fmt::format("These are {} shapes; a table of all pairs is made of at most {}. "
                                 "Choose a class or a word of the names.",
                                 names.size(), serve::kMostMatrixShapes)};
}

std::string Server::Service::matrix(const std::vector<std::string>& names,
                                    const Progress* progress) const {
  return serve::matrix_json(database_.matrix_of(names, {}, options_.threads, progress));
}

void Server::Service::thumbnail(const Request& request, Response& response) {
  const StoredShape shape = stored(needed(request, "name"));
  const std::string tag = "\"" + shape.data.content + "\"";
  response.set_header("ETag", tag);
  // Asked again each time, sent again only when it differs.
  response.headers.erase("Cache-Control");
  response.set_header("Cache-Control", "private, no-cache");
  if (request.get_header_value("If-None-Match") == tag) {
    response.status = 304;
    return;
  }
  const std::string png = heavy_.take([&] { return draw_thumbnail(shape.data.sketch, 192); });
  response.set_content(png, "image/png");
}

void Server::Service::log_in(const Request& request, Response& response) {
  const auto json = nlohmann::json::parse(request.body, nullptr, false);
  const bool given = json.is_object() && json.contains("token") && json["token"].is_string();
  if (!given) throw Failure{400, "expected {\"token\": \"…\"}"};
  const auto cookie = guard_.log_in(json["token"].get<std::string>());
  if (!cookie) throw Failure{401, "This is not the token."};
  response.set_header("Set-Cookie", *cookie);
  response.status = 204;
}

void Server::Service::receive(const Request& request, Response& response,
                              const httplib::ContentReader& reader) {
  if (request.get_header_value("Content-Type") != "application/octet-stream") {
    throw Failure{415, "send the file's bytes as application/octet-stream"};
  }
  const std::string name = file_name(needed(request, "name"));
  serve::Uploads::Room room(uploads_);
  bool refused = false;
  const bool complete = reader([&](const char* data, std::size_t size) {
    refused = !room.add(data, size);
    return !refused;
  });
  if (room.too_large()) {
    throw too_large(options_);
  }
  if (refused) throw Failure{503, "Too many files are being sent; try again in a moment."};
  if (!complete) throw Failure{400, "The file did not arrive as a whole."};
  const auto id = uploads_.add(name, room.take());
  if (!id) throw Failure{503, "Too many files are waiting to be segmented; try again soon."};
  response.status = 202;
  response.set_content(serve::upload_json(*id, *uploads_.state(*id)), kJson);
}

void Server::Service::report_upload(const Request& request, Response& response) {
  const std::string id = needed(request, "id");
  if (!uploads_.state(id)) {
    throw no_such_upload();
  }
  auto version = std::make_shared<std::uint64_t>(0);
  response.set_chunked_content_provider(
      "text/event-stream", [this, id, version](std::size_t, httplib::DataSink& sink) {
        constexpr std::chrono::seconds kHeartbeat{5};
        const auto state = uploads_.wait(id, *version, kHeartbeat);
        if (!state) return false;
        if (state->version == *version) return write_heartbeat(sink);
        *version = state->version;
        if (!write_event(sink, serve::upload_json(id, *state))) return false;
        if (!serve::is_open(state->stage)) sink.done();
        return true;
      });
}

// The share that is done, again and again; at the end the table, or why there is none.
void Server::Service::report_matrix(const Request& request, Response& response) {
  auto work = std::make_shared<serve::WatchedWork>(
      [this, names = matrix_names(request)](const Progress& progress) {
        return heavy_.take([&] { return matrix(names, &progress); });
      });
  auto told = std::make_shared<int>(-1);
  response.set_chunked_content_provider(
      "text/event-stream", [this, work, told](std::size_t, httplib::DataSink& sink) {
        constexpr std::chrono::seconds kHeartbeat{1};
        if (http_.stopping()) return false;
        if (const auto hundredths = work->wait(kHeartbeat)) {
          if (std::exchange(*told, *hundredths) == *hundredths) return write_heartbeat(sink);
          return write_event(sink, fmt::format("{{\"fraction\":{:.2f}}}\n", 0.01 * *hundredths));
        }
        std::string answer;
        try {
          answer = work->take();
        } catch (...) {
          answer = serve::error_json(failure_of(std::current_exception()).message);
        }
        if (!write_event(sink, answer)) return false;
        sink.done();
        return true;
      });
}

Server::Server(const Database& database, const ServeOptions& options)
    : service_(std::make_unique<Service>(database, options)) {}
Server::~Server() = default;
const std::string& Server::address() const { return service_->address(); }
void Server::run() { service_->run(); }
void Server::stop() noexcept { service_->stop(); }

}  // namespace morsel
