// The page that `morsel segment --html` writes: one shape, carried by the page itself.
import './page.css';
import { parseShape } from './shape/format';
import { PartView } from './ui/part_view';
import { Theme } from './ui/theme';

const shape = parseShape(document.getElementById('shape')!.textContent!);
document.title = `${shape.name} – morsel`;
const main = document.body.appendChild(document.createElement('main'));
new PartView(main, shape, new Theme());
