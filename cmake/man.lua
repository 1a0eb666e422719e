-- Makes a man page of a manual in docs/: options and tables become lists of terms, code is bold, links within docs/
-- become names of manuals, or of pages of the documentation.
--   pandoc -s -f markdown-smart -t man -L cmake/man.lua docs/bpmesh.1.md -o bpmesh.1

-- `--voxel LENGTH`: names bold, the value in italics.
local function term(text)
  local out = pandoc.List()
  for word in text:gmatch("%S+") do
    if #out > 0 then out:insert(pandoc.Space()) end
    local comma = word:match("^(%-.*),$")
    if comma then
      out:extend({ pandoc.Strong(pandoc.Str(comma)), pandoc.Str(",") })
    elseif word:match("^%-") or word:match("^[a-z]") then
      out:insert(pandoc.Strong(pandoc.Str(word)))
    else
      out:insert(pandoc.Emph(pandoc.Str(word)))
    end
  end
  return out
end

-- A list whose items all begin with `code`: and a text.
local function definitions(list)
  local items = pandoc.List()
  for _, blocks in ipairs(list.content) do
    local first = blocks[1]
    local code, colon = first and first.content and first.content[1], first and first.content and first.content[2]
    if not (code and code.t == "Code" and colon and colon.t == "Str" and colon.text == ":") then return nil end
    local text = pandoc.List()
    for i = 3, #first.content do text:insert(first.content[i]) end
    if text[1] and text[1].t == "Space" then text:remove(1) end
    local body = pandoc.List({ pandoc.Plain(text) })
    for i = 2, #blocks do body:insert(blocks[i]) end
    items:insert({ term(code.text), { body } })
  end
  return pandoc.DefinitionList(items)
end

-- A table of 80 columns leaves no room for text: its first column becomes terms, the others what is said of them.
local function rows(element)
  local items = pandoc.List()
  for _, body in ipairs(element.bodies) do
    for _, row in ipairs(body.body) do
      local text = pandoc.List()
      for i = 2, #row.cells do
        if i > 2 then text:extend({ pandoc.Str(";"), pandoc.Space() }) end
        text:extend(pandoc.utils.blocks_to_inlines(row.cells[i].contents))
      end
      items:insert({ pandoc.utils.blocks_to_inlines(row.cells[1].contents), { pandoc.List({ pandoc.Plain(text) }) } })
    end
  end
  return pandoc.DefinitionList(items)
end

-- What is no manual is a page of the documentation; FILES tells where these are.
local has_pages = false
local function link(element)
  if element.target:match("^%a+://") then return nil end
  if element.target:match("%.1%.md$") then return element.content end
  local name = pandoc.utils.stringify(element.content)
  has_pages = true
  if name == element.target or name .. ".md" == element.target then return pandoc.Str(element.target) end
  return element.content .. { pandoc.Space(), pandoc.Str("(" .. element.target .. ")") }
end

local function add_files(document)
  local folder = document.meta.docs
  if not (has_pages and folder) then return nil end
  document.blocks:insert(pandoc.Header(1, "FILES"))
  local text = "Pages that end with .md are in " .. pandoc.utils.stringify(folder) .. "."
  document.blocks:insert(pandoc.Para(pandoc.Str(text)))
  return document
end

-- Lines as they are; a long pipe goes on in a second line, as a shell takes it. pandoc's font "C" is not known to every
-- program that shows man pages.
local function example(block)
  local lines = pandoc.List()
  for line in (block.text .. "\n"):gmatch("(.-)\n") do
    if #line > 71 then line = line:gsub("^(.*) | (.-)$", "%1 |\n    %2") end
    lines:insert(line)
  end
  local text = table.concat(lines, "\n"):gsub("\\", "\\e"):gsub("%-", "\\-"):gsub("'", "\\(aq")
  text = ("\n" .. text):gsub("\n([.'])", "\n\\&%1"):sub(2)
  return pandoc.RawBlock("man", ".RS 2\n.nf\n" .. text .. "\n.fi\n.RE")
end

return {
  { BulletList = definitions },
  {
    Code = function(code) return pandoc.Strong(pandoc.Str(code.text)) end,
    Link = link,
    Table = rows,
    CodeBlock = example,
    Image = function() return {} end,
  },
  { Pandoc = add_files },
}
