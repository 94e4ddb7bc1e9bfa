// text=corrected: no slip of a source text is reproduced (docs/sources.md).
