-- Makes a man page of a manual in docs/: options become a list of terms, code is bold, links within docs/ are text.
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

-- Lines as they are. pandoc's font "C" is not known to every program that shows man pages.
local function example(block)
  local text = block.text:gsub("\\", "\\e"):gsub("%-", "\\-"):gsub("'", "\\(aq")
  text = ("\n" .. text):gsub("\n([.'])", "\n\\&%1"):sub(2)
  return pandoc.RawBlock("man", ".IP\n.nf\n" .. text .. "\n.fi")
end

return {
  { BulletList = definitions },
  {
    Code = function(code) return pandoc.Strong(pandoc.Str(code.text)) end,
    Link = function(link)
      if not link.target:match("^%a+://") then return link.content end
    end,
    CodeBlock = example,
    Image = function() return {} end,
  },
}
