-- What wrk sends, and what came of it as one line of JSON. Usage: wrk … -s requests.lua URL -- FILE
-- FILE holds one request a line: METHOD PATH [FILE OF THE BODY].

local threads = {}

function setup(thread)
  table.insert(threads, thread)
  thread:set("number", #threads)
end

function init(arguments)
  requests, statuses, at = {}, "", number * 7919
  counts = {}
  for line in io.lines(arguments[1]) do
    local method, path, body = line:match("^(%S+) (%S+) ?(.*)$")
    local headers, content = {}, nil
    if body ~= "" then
      headers["Content-Type"] = "application/octet-stream"
      content = assert(io.open(body, "rb")):read("*a")
    end
    table.insert(requests, wrk.format(method, path, headers, content))
  end
end

function request()
  at = at + 1
  return requests[at % #requests + 1]
end

-- As Retry-After asks for.
function delay()
  return last == 503 and 2000 or 0
end

function response(status)
  last = status
  counts[status] = (counts[status] or 0) + 1
  statuses = ""
  for code, count in pairs(counts) do statuses = statuses .. code .. " " .. count .. "\n" end
end

function done(summary, latency)
  local sums = {}
  for _, thread in ipairs(threads) do
    for code, count in (thread:get("statuses") or ""):gmatch("(%d+) (%d+)") do
      sums[code] = (sums[code] or 0) + tonumber(count)
    end
  end
  local parts = {}
  for code, count in pairs(sums) do table.insert(parts, string.format('"%s": %d', code, count)) end
  local e = summary.errors
  io.write(string.format(
    '{"median": %.4f, "p99": %.4f, "most": %.4f, "broken": %d, "timeouts": %d, "statuses": {%s}}\n',
    latency:percentile(50) / 1e6, latency:percentile(99) / 1e6, latency.max / 1e6,
    e.connect + e.read + e.write, e.timeout, table.concat(parts, ", ")))
end
