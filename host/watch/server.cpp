#include "watch/server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <thread>

#include "look/look_picture.h"
#include "look/page.h"
#include "watch/session.h"
#include "wrinkle/error.h"

namespace wrinkle {

using nlohmann::json;

namespace {

constexpr char kAddress[] = "127.0.0.1";
constexpr std::size_t kThreads = 32;  // pages that wait for news hold one each
constexpr std::size_t kLongestBody = 1 << 20;
constexpr std::chrono::seconds kLongestWait{10};
constexpr int kBadRequest = 400, kForbidden = 403, kNotFound = 404, kConflict = 409;
// With a charset, or httplib would pack it, which takes longer than sending it to oneself.
constexpr char kJson[] = "application/json; charset=utf-8";

void answer(httplib::Response& response, int status, const std::string& text) {
    response.status = status;
    response.set_content(text, "text/plain; charset=utf-8");
}

template <class Number>
std::optional<Number> parameter(const httplib::Request& request, const char* name) {
    const std::string text = request.get_param_value(name);
    Number value{};
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failed == std::errc() && end == text.data() + text.size() && !text.empty() ? std::optional(value)
                                                                                      : std::nullopt;
}

}  // namespace

std::string why_refused(const RequestOrigin& request, int port) {
    const std::string here = fmt::format("{}:{}", kAddress, port), local = fmt::format("localhost:{}", port);
    if (request.host != here && request.host != local)
        return fmt::format("this page is at http://{}/ and under no other name", here);
    if (!request.fetch_site.empty() && request.fetch_site != "same-origin" && request.fetch_site != "none")
        return "pages of other sites may ask for nothing here";
    if (request.method == "GET" || request.method == "HEAD") return {};
    if (request.method != "POST") return "only GET and POST are known";
    if (request.origin != "http://" + request.host) return "only the page itself may change anything";
    return {};
}

struct WatchServer::Impl {
    explicit Impl(WatchBoard& of) : board(of) {
        server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
        server.set_keep_alive_timeout(1);
        server.set_tcp_nodelay(true);
        server.set_payload_max_length(kLongestBody);
        // httplib would let another process have the same port, and either get half of the requests.
        server.set_socket_options([](int socket) {
            const int on = 1;
            ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        });
        server.set_default_headers({{"Cache-Control", "no-store"},
                                    {"Cross-Origin-Resource-Policy", "same-origin"},
                                    {"X-Content-Type-Options", "nosniff"},
                                    {"X-Frame-Options", "DENY"},
                                    {"Referrer-Policy", "no-referrer"}});
        server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            const std::string why = why_refused(
                {request.method,
                 request.get_header_value_count("Host") == 1 ? request.get_header_value("Host") : std::string{},
                 request.get_header_value("Origin"), request.get_header_value("Sec-Fetch-Site")},
                port);
            if (why.empty()) return httplib::Server::HandlerResponse::Unhandled;
            answer(response, kForbidden, why + "\n");
            return httplib::Server::HandlerResponse::Handled;
        });
        add_gets();
        add_posts();
    }

    void add_gets() {
        server.Get("/", [this](const httplib::Request&, httplib::Response& response) {
            const auto shown = board.shown();
            response.set_content(page_of(json::parse(shown.state, nullptr, false), true), "text/html; charset=utf-8");
        });
        server.Get("/state", [this](const httplib::Request& request, httplib::Response& response) {
            const auto after = parameter<std::uint64_t>(request, "after");
            if (!after) return answer(response, kBadRequest, "expected /state?after=VERSION");
            response.set_content(board.shown(*after, kLongestWait).state, kJson);
        });
        server.Get("/picture/([a-z_]+)", [this](const httplib::Request& request, httplib::Response& response) {
            const auto image = board.shown().image;
            const auto png = image ? png_of(*image, request.matches[1]) : std::nullopt;
            if (!png) return answer(response, kNotFound, "there is no such picture");
            response.set_content(*png, "image/png");
        });
        server.Get("/pixel", [this](const httplib::Request& request, httplib::Response& response) {
            const auto x = parameter<std::uint32_t>(request, "x"), y = parameter<std::uint32_t>(request, "y");
            if (!x || !y) return answer(response, kBadRequest, "expected /pixel?x=X&y=Y");
            done(response, [x, y](WatchSession& session) { return session.pixel(*x, *y); });
        });
    }

    void add_posts() {
        post("/numbers", [](const json& body) -> WatchBoard::Task {
            auto numbers = body.get<std::map<std::string, double>>();
            return [numbers](WatchSession& session) { return session.set_numbers(numbers), "{}"; };
        });
        post("/layers", [](const json& body) -> WatchBoard::Task {
            auto off = body.at("off").get<std::set<std::string>>();
            return [off](WatchSession& session) { return session.switch_off(off), "{}"; };
        });
        post("/condition", [](const json& body) -> WatchBoard::Task {
            const bool wanted = body.at("on").get<bool>();
            return [wanted](WatchSession& session) { return session.want_condition(wanted), "{}"; };
        });
        post("/write", [](const json&) -> WatchBoard::Task {
            return [](WatchSession& session) { return session.write_numbers(), "{}"; };
        });
    }

    void post(const char* path, WatchBoard::Task (*task_of)(const json&)) {
        server.Post(path, [this, task_of](const httplib::Request& request, httplib::Response& response) {
            WatchBoard::Task task;
            try {
                task = task_of(json::parse(request.body));
            } catch (const json::exception&) {
                return answer(response, kBadRequest, "this is not what the page sends");
            }
            done(response, std::move(task));
        });
    }

    void done(httplib::Response& response, WatchBoard::Task task) {
        try {
            response.set_content(board.ask(std::move(task)), kJson);
        } catch (const Error& error) { answer(response, kConflict, error.what()); }
    }

    WatchBoard& board;
    httplib::Server server;
    int port = 0;
};

WatchServer::WatchServer(WatchBoard& board, int port) : impl_(std::make_unique<Impl>(board)) {
    const bool bound = port == 0 ? (impl_->port = impl_->server.bind_to_any_port(kAddress)) > 0
                                 : impl_->server.bind_to_port(kAddress, port);
    if (!bound)
        throw Error(port == 0 ? fmt::format("no port of {} can be had", kAddress)
                              : fmt::format("port {} of {} cannot be had: another program has it, or only root may; "
                                            "give another --port, or none for any that is free",
                                            port, kAddress));
    if (port != 0) impl_->port = port;
}

WatchServer::~WatchServer() = default;

int WatchServer::port() const { return impl_->port; }
std::string WatchServer::url() const { return fmt::format("http://{}:{}/", kAddress, impl_->port); }
void WatchServer::serve() { impl_->server.listen_after_bind(); }
void WatchServer::stop() {
    // httplib forgets a stop() that comes before it has begun to listen.
    for (int tries = 0; tries < 1000 && !impl_->server.is_running(); ++tries)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    impl_->server.stop();
}

}  // namespace wrinkle
