//! Header, tables and objects of a DXF of version AC1015 (AutoCAD 2000).
//!
//! Every record is a row of fixed pairs and the few values that depend on the drawing.

use super::super::dimension::{EXTENSION, HEAD, TEXT_GAP};
use super::super::plane::Bounds;
use super::layer::{LayerRow, Layers, LineType};
use super::pairs::{Handle, Handles, Pairs};

/// Facts about the drawing that tables and header state.
pub(super) struct Facts {
    /// Extent in mm.
    pub bounds: Bounds,
    /// Millimeters of a pixel of the picture that the signs were drafted for.
    pub factor: f64,
    /// Height of the capitals of dimensions, in mm.
    pub capitals: f64,
    /// Decimals of dimensions.
    pub decimals: usize,
    /// Largest distance of a curve from its polyline, in m; `None` without curves.
    pub deviation: Option<f64>,
}

/// Viewport that opens on the whole drawing.
const VIEWPORT: [(u16, &str); 29] = [
    (2, "*Active"),
    (70, "0"),
    (10, "0.0"),
    (20, "0.0"),
    (11, "1.0"),
    (21, "1.0"),
    (13, "0.0"),
    (23, "0.0"),
    (14, "10.0"),
    (24, "10.0"),
    (15, "10.0"),
    (25, "10.0"),
    (16, "0.0"),
    (26, "0.0"),
    (36, "1.0"),
    (17, "0.0"),
    (27, "0.0"),
    (37, "0.0"),
    (42, "50.0"),
    (43, "0.0"),
    (44, "0.0"),
    (50, "0.0"),
    (51, "0.0"),
    (71, "0"),
    (72, "1000"),
    (73, "1"),
    (74, "3"),
    (75, "0"),
    (76, "0"),
];

const TEXT_STYLE: [(u16, &str); 9] = [
    (2, "Standard"),
    (70, "0"),
    (40, "0.0"),
    (41, "1.0"),
    (50, "0.0"),
    (71, "0"),
    (42, "2.5"),
    (3, "arial.ttf"),
    (4, ""),
];

/// Dimensions whose text lies along and above the line, in decimals without zeros at their end, and whose line is always complete.
const DIMENSION_STYLE: [(u16, &str); 8] = [
    (40, "1.0"),
    (73, "0"),
    (74, "0"),
    (77, "1"),
    (78, "8"),
    (172, "1"),
    (277, "2"),
    (278, "46"),
];

/// Value of a variable of the header.
enum Variable {
    Word(u16, String),
    Point([f64; 2]),
    Real(f64),
}

/// Adds the header; `next` is a handle that the file does not use.
pub(super) fn header(pairs: &mut Pairs, facts: &Facts, next: Handle) {
    let integer = |value: i64| Variable::Word(70, value.to_string());
    let word = |code: u16, word: &str| Variable::Word(code, word.to_string());
    let variables = [
        ("$ACADVER", word(1, "AC1015")),
        ("$DWGCODEPAGE", word(3, "ANSI_1252")),
        ("$INSBASE", Variable::Point([0.0; 2])),
        ("$EXTMIN", Variable::Point(facts.bounds.low)),
        ("$EXTMAX", Variable::Point(facts.bounds.high)),
        ("$LTSCALE", Variable::Real(1.0)),
        ("$TEXTSIZE", Variable::Real(facts.capitals)),
        ("$TEXTSTYLE", word(7, "Standard")),
        ("$CLAYER", word(8, "0")),
        ("$CELTYPE", word(6, "ByLayer")),
        ("$DIMSTYLE", word(2, "Standard")),
        ("$LUNITS", integer(2)),
        ("$LUPREC", integer(4)),
        ("$AUNITS", integer(0)),
        ("$HANDSEED", Variable::Word(5, format!("{:X}", next.0))),
        // Millimeters, in a metric drawing.
        ("$INSUNITS", integer(4)),
        ("$MEASUREMENT", integer(1)),
    ];
    for (name, value) in variables {
        pairs.word(9, name);
        match value {
            Variable::Word(code, word) => pairs.word(code, &word),
            Variable::Point(point) => pairs.point(10, point),
            Variable::Real(value) => pairs.real(40, value),
        };
    }
}

/// Adds all tables. `blocks` are the names of blocks with the handles of their records.
pub(super) fn tables(
    pairs: &mut Pairs,
    handles: &mut Handles,
    facts: &Facts,
    layers: &Layers,
    blocks: &[(String, Handle)],
) {
    let style = handles.next();
    table(pairs, handles, "VPORT", 1, |record| {
        record.begin("AcDbViewportTableRecord");
        let [width, height] = facts.bounds.size();
        record.pairs.all(&VIEWPORT).flat(12, facts.bounds.center());
        record
            .pairs
            .real(40, 1.1 * height.max(0.6 * width))
            .real(41, 1.6);
    });
    table(pairs, handles, "LTYPE", 2 + LineType::ALL.len(), |record| {
        for name in ["ByBlock", "ByLayer"] {
            record.begin("AcDbLinetypeTableRecord");
            record.line_type(name, "", &[], facts.factor);
        }
        for (name, description, dashes) in LineType::ALL.map(LineType::definition) {
            record.begin("AcDbLinetypeTableRecord");
            record.line_type(name, description, dashes, facts.factor);
        }
    });
    table(
        pairs,
        handles,
        "LAYER",
        1 + layers.rows().count(),
        |record| {
            let default = LayerRow {
                name: "0".to_string(),
                color: 7,
                line_type: LineType::Continuous,
                width: -3,
                is_plotted: true,
            };
            for row in std::iter::once(&default).chain(layers.rows()) {
                record.begin("AcDbLayerTableRecord");
                record.pairs.text(2, &row.name).integer(70, 0);
                record.pairs.integer(62, row.color);
                record.pairs.word(6, row.line_type.definition().0);
                record.pairs.integer(290, i64::from(row.is_plotted));
                record.pairs.integer(370, row.width);
            }
        },
    );
    table(pairs, handles, "STYLE", 1, |record| {
        record.begin_with("AcDbTextStyleTableRecord", style);
        record.pairs.all(&TEXT_STYLE);
    });
    table(pairs, handles, "VIEW", 0, |_| {});
    table(pairs, handles, "UCS", 0, |_| {});
    table(pairs, handles, "APPID", 1, |record| {
        record.begin("AcDbRegAppTableRecord");
        record.pairs.word(2, "ACAD").integer(70, 0);
    });
    table(pairs, handles, "DIMSTYLE", 1, |record| {
        record.begin("AcDbDimStyleTableRecord");
        let pairs = &mut *record.pairs;
        pairs.word(2, "Standard").integer(70, 0);
        let [gap, beyond] = EXTENSION;
        let lengths = [(41, HEAD), (42, gap), (44, beyond), (147, TEXT_GAP)];
        for (code, length) in lengths {
            pairs.real(code, length * facts.factor);
        }
        pairs.real(140, facts.capitals).all(&DIMENSION_STYLE);
        pairs.integer(271, facts.decimals as i64).handle(340, style);
    });
    table(pairs, handles, "BLOCK_RECORD", blocks.len(), |record| {
        for (name, handle) in blocks {
            record.begin_with("AcDbBlockTableRecord", *handle);
            record.pairs.word(2, name);
        }
    });
}

/// Adds the dictionaries that a file must have.
pub(super) fn objects(pairs: &mut Pairs, handles: &mut Handles) {
    let [root, groups] = [handles.next(), handles.next()];
    pairs
        .word(0, "DICTIONARY")
        .handle(5, root)
        .handle(330, Handle(0));
    pairs.word(100, "AcDbDictionary").integer(281, 1);
    pairs.word(3, "ACAD_GROUP").handle(350, groups);
    pairs
        .word(0, "DICTIONARY")
        .handle(5, groups)
        .handle(330, root);
    pairs.word(100, "AcDbDictionary").integer(281, 1);
}

/// Records of a table.
struct Records<'a> {
    pairs: &'a mut Pairs,
    handles: &'a mut Handles,
    kind: &'static str,
    table: Handle,
}

impl Records<'_> {
    fn begin(&mut self, class: &str) {
        let handle = self.handles.next();
        self.begin_with(class, handle);
    }

    fn begin_with(&mut self, class: &str, handle: Handle) {
        let code = if self.kind == "DIMSTYLE" { 105 } else { 5 };
        self.pairs.word(0, self.kind).handle(code, handle);
        self.pairs.handle(330, self.table);
        self.pairs
            .word(100, "AcDbSymbolTableRecord")
            .word(100, class);
    }

    fn line_type(&mut self, name: &str, description: &str, dashes: &[f64], factor: f64) {
        let length: f64 = dashes.iter().map(|it| it.abs()).sum();
        self.pairs.word(2, name).integer(70, 0).word(3, description);
        self.pairs.integer(72, 65).integer(73, dashes.len() as i64);
        self.pairs.real(40, length * factor);
        for dash in dashes {
            self.pairs.real(49, dash * factor).integer(74, 0);
        }
    }
}

fn table(
    pairs: &mut Pairs,
    handles: &mut Handles,
    kind: &'static str,
    count: usize,
    rows: impl FnOnce(&mut Records<'_>),
) {
    let handle = handles.next();
    pairs
        .word(0, "TABLE")
        .word(2, kind)
        .handle(5, handle)
        .handle(330, Handle(0));
    pairs.word(100, "AcDbSymbolTable").integer(70, count as i64);
    if kind == "DIMSTYLE" {
        pairs.word(100, "AcDbDimStyleTable").integer(71, 0);
    }
    rows(&mut Records {
        pairs,
        handles,
        kind,
        table: handle,
    });
    pairs.word(0, "ENDTAB");
}
