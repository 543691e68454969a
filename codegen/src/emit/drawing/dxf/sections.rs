//! Sections of a DXF in their order.

use super::super::dimension::Dimension;
use super::entity::{Entity, Shape, dimension_block};
use super::layer::{Content, Layers};
use super::pairs::{Handle, Handles, Pairs};
use super::tables::{Facts, header, objects, tables};

/// Entities and dimensions of a drawing.
pub(super) struct Sections {
    pub entities: Vec<Entity>,
    pub dimensions: Vec<Dimension>,
    /// Largest coordinate, in mm.
    pub extent: f64,
}

/// Blocks that every file has.
const SPACES: [&str; 2] = ["*Model_Space", "*Paper_Space"];

impl Sections {
    /// Text of the file.
    pub fn text(mut self, mut layers: Layers, facts: &Facts) -> String {
        let mut file = Pairs::of_extent(self.extent);
        let mut handles = Handles::new();
        let names = SPACES.map(String::from).into_iter();
        let names = names.chain((1..=self.dimensions.len()).map(|number| format!("*D{number}")));
        let records: Vec<(String, Handle)> = names.map(|name| (name, handles.next())).collect();
        let blocks = self.blocks(file.alike(), &mut handles, &mut layers, &records);
        let names = records.iter().skip(SPACES.len());
        for (dimension, (name, _)) in std::mem::take(&mut self.dimensions).into_iter().zip(names) {
            self.entities.push(Entity {
                layer: layers.name(Content::Dimensions, &[]),
                line_type: None,
                shape: Shape::Dimension(Box::new(dimension), name.clone()),
            });
        }
        let mut entities = file.alike();
        for entity in &self.entities {
            entity.write(&mut entities, handles.next(), records[0].1);
        }
        let [mut named, mut listed] = [file.alike(), file.alike()];
        tables(&mut named, &mut handles, facts, &layers, &records);
        objects(&mut listed, &mut handles);
        if let Some(deviation) = facts.deviation {
            let millimeters = 1000.0 * deviation;
            let words = format!("Curves lie within {millimeters:.1e} mm of their polylines.");
            file.word(999, &words);
        }
        let mut variables = file.alike();
        header(&mut variables, facts, handles.next());
        let sections = [
            ("HEADER", variables),
            ("CLASSES", file.alike()),
            ("TABLES", named),
            ("BLOCKS", blocks),
            ("ENTITIES", entities),
            ("OBJECTS", listed),
        ];
        for (name, pairs) in sections {
            file.word(0, "SECTION")
                .word(2, name)
                .append(&pairs)
                .word(0, "ENDSEC");
        }
        file.word(0, "EOF");
        file.into_text()
    }

    /// Blocks: the spaces, which entities fill, and one for each dimension.
    fn blocks(
        &self,
        mut pairs: Pairs,
        handles: &mut Handles,
        layers: &mut Layers,
        records: &[(String, Handle)],
    ) -> Pairs {
        for (place, (name, record)) in records.iter().enumerate() {
            let dimension = place
                .checked_sub(SPACES.len())
                .map(|it| &self.dimensions[it]);
            let begin = |pairs: &mut Pairs, kind: &str, class: &str, handle: Handle| {
                pairs.word(0, kind).handle(5, handle).handle(330, *record);
                pairs.word(100, "AcDbEntity").word(8, "0").word(100, class);
            };
            begin(&mut pairs, "BLOCK", "AcDbBlockBegin", handles.next());
            // Blocks of dimensions are anonymous.
            pairs
                .word(2, name)
                .integer(70, i64::from(dimension.is_some()));
            pairs.point(10, [0.0; 2]).word(3, name).word(1, "");
            for (shape, is_point) in dimension.map(dimension_block).into_iter().flatten() {
                let content = if is_point {
                    Content::Points
                } else {
                    Content::Dimensions
                };
                let entity = Entity {
                    layer: layers.name(content, &[]),
                    line_type: None,
                    shape,
                };
                entity.write(&mut pairs, handles.next(), *record);
            }
            begin(&mut pairs, "ENDBLK", "AcDbBlockEnd", handles.next());
        }
        pairs
    }
}
